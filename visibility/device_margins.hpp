// What a device's own rules of rasterisation may move, which bounds of boxes must leave room for.
#pragma once

namespace triptych {

/// Pixels. Of OpenGL, whose specification leaves more room than any other device, unless said otherwise.
struct DeviceMargins {
  /// By how much the projection of a box grows on each side, besides what rounding in the vertex stage asks
  /// for. OpenGL snaps vertices of the content, and those of the rectangle that is tested, to 1/16 pixel at
  /// most; where rounding is bounded by an eighth of a pixel, positions are off by 0.325 pixels at most.
  double outline = 0.5;
  /// For how far a vertex may move across the screen, planes of faces move towards the eye. OpenGL: 1/16
  /// pixel in both directions, of content and rectangle.
  double plane = 0.25;
  /// How many times the bound on rounding in the vertex stage the outline leaves room for, where that is
  /// more.
  double roundings = 4;
};

}  // namespace triptych
