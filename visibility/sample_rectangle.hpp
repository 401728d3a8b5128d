// Rectangles under test, as one sample of every pixel sees them.
#pragma once

#include "scene/sample_places.hpp"
#include "visibility/screen_bounds.hpp"

namespace triptych {

/// What is tested at pixel centres in place of the rectangle is what it is at that sample of each pixel, in a
/// picture of width × height pixels. Each plane, cut and side moves by a rounding of its own more, for which
/// their margins have room: depths and cuts leave 2⁻²⁰ of their terms, of which this takes 2⁻²⁴; sides 0.17
/// pixels on any device, of which it takes 0.001 in the largest picture.
ScreenRectangle at_sample(const ScreenRectangle& rectangle, const SamplePlace& place, int width, int height);
ScreenExtent at_sample(const ScreenExtent& extent, const SamplePlace& place, int width, int height);

}  // namespace triptych
