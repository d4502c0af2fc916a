// Owning handles of cairo's surfaces and contexts.
#pragma once

#include <memory>

#include <cairo.h>

namespace forage::plot {

struct DestroyCairo {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
    void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroyCairo>;
using CairoContext = std::unique_ptr<cairo_t, DestroyCairo>;

}  // namespace forage::plot
