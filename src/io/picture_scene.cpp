#include "io/picture_scene.hpp"

#include <vtkAutoInit.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>

#include "core/errors.hpp"
#include "io/picture_captions.hpp"
#include "io/picture_views.hpp"
#include "io/vtk_threads.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace knap {
namespace {

constexpr int enlargement = 2;         // drawn larger and averaged: smooth edges whatever the OpenGL
constexpr double views_bottom = 0.15;  // share of the height
constexpr double views_top = 0.86;

enum Layer { Backdrop, Views, Captions, NumLayers };

void add_layer(vtkRenderWindow* window, vtkRenderer* renderer, Layer layer) {
  renderer->SetLayer(layer);
  renderer->SetBackground(1.0, 1.0, 1.0);
  window->AddRenderer(renderer);
}

template <class AddView>
void add_view(vtkRenderWindow* window, int column, AddView&& add) {
  vtkNew<vtkRenderer> view;
  view->SetViewport(column / 3.0, views_bottom, (column + 1) / 3.0, views_top);
  add_layer(window, view, Views);
  add(view.Get());
}

/// Throws RuntimeFailure for a picture of one colour: OpenGL can fail without a word.
void check_drawn(vtkImageData* image) {
  const auto* first = static_cast<const unsigned char*>(image->GetScalarPointer());
  const auto size = static_cast<std::size_t>(3 * image->GetNumberOfPoints());
  const bool one_colour = std::equal(first + 3, first + size, first);
  if (one_colour) throw RuntimeFailure("OpenGL drew nothing");
}

std::string png_of(vtkRenderWindow* window) {
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(grab->GetOutputPort());
  average->SetShrinkFactors(enlargement, enlargement, 1);
  average->MeanOn();
  average->Update();
  check_drawn(average->GetOutput());
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

}  // namespace

std::string png_of_picture(const PictureInput& input, const PictureGeometry& geometry) {
  use_one_vtk_thread();
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(enlargement * picture_width, enlargement * picture_height);
  window->SetNumberOfLayers(NumLayers);
  if (window->SupportsOpenGL() == 0) throw RuntimeFailure("no OpenGL 3.2 on this display");
  vtkNew<vtkRenderer> backdrop;
  add_layer(window, backdrop, Backdrop);
  add_view(window, 0, [&](vtkRenderer* view) { add_outside_view(view, input, geometry); });
  add_view(window, 1, [&](vtkRenderer* view) { add_cut_view(view, input, geometry); });
  add_view(window, 2, [&](vtkRenderer* view) { add_exploded_view(view, input, geometry); });
  vtkNew<vtkRenderer> captions;
  add_layer(window, captions, Captions);
  add_captions(captions, input, geometry, enlargement);
  window->Render();
  return png_of(window);
}

}  // namespace knap
