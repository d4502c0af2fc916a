// Pictures, for the tests of this room.
#pragma once

#include "tests/support/catch.h"
#include "tools/plot/cairo_handle.h"
#include "tools/plot/canvas.h"
#include "tools/plot/colours.h"

namespace forage::plot {

/// The number of pixels of a picture in which no part differs from a colour by more than `tolerance`, 0..255.
inline int pixels_of(const Picture& picture, const Colour& colour, int tolerance = 0) {
    const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(picture.width),
                                                          static_cast<int>(picture.height)));
    const CairoContext context(cairo_create(surface.get()));
    Canvas canvas(context.get());
    picture.draw(canvas);
    cairo_surface_flush(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    int out = 0;
    for (int y = 0; y < static_cast<int>(picture.height); ++y)
        for (int x = 0; x < static_cast<int>(picture.width); ++x) {
            const unsigned char* bgr = cairo_image_surface_get_data(surface.get()) + y * stride + 4 * x;
            const auto near = [&](int i, double v) { return std::abs(bgr[i] - v * 255) <= tolerance + 0.5; };
            out += near(2, colour.r) && near(1, colour.g) && near(0, colour.b);
        }
    return out;
}

}  // namespace forage::plot
