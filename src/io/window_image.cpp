#include "io/window_image.hpp"

#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>

#include "core/errors.hpp"

namespace knap {
namespace {

void check_drawn(vtkImageData* image) {
  const auto* first = static_cast<const unsigned char*>(image->GetScalarPointer());
  const auto size = static_cast<std::size_t>(3 * image->GetNumberOfPoints());
  const bool one_colour = std::equal(first + 3, first + size, first);
  if (one_colour) throw RuntimeFailure("OpenGL drew nothing");
}

}  // namespace

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

}  // namespace knap
