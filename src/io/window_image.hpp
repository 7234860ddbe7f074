#pragma once
#include <vtkRenderWindow.h>

#include <string>

namespace knap {

/// Windows are drawn larger by this and averaged: smooth edges whatever the OpenGL.
inline constexpr int enlargement = 2;

/// The bytes of a PNG of a window that was rendered at `enlargement` times its final size. Throws RuntimeFailure for a
/// picture of one colour: OpenGL can fail without a word.
std::string png_of(vtkRenderWindow* window);

}  // namespace knap
