// Owning handles of cairo's surfaces and contexts.
#pragma once

#include <cstdint>
#include <memory>

#include <cairo.h>

#include "tools/plot/gif.h"

namespace forage::plot {

struct DestroyCairo {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
    void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroyCairo>;
using CairoContext = std::unique_ptr<cairo_t, DestroyCairo>;

/// The pixels of an image surface in the format RGB24.
inline Pixels pixels_of(cairo_surface_t* surface) {
    cairo_surface_flush(surface);
    return {cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface),
            static_cast<std::size_t>(cairo_image_surface_get_stride(surface)) / sizeof(std::uint32_t),
            reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface))};
}

}  // namespace forage::plot
