#include "io/picture_scene.hpp"

#include <vtkAutoInit.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "core/errors.hpp"
#include "io/picture_captions.hpp"
#include "io/picture_views.hpp"
#include "io/vtk_threads.hpp"
#include "io/window_image.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace knap {
namespace {

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
