#include "tools/studio/server/assets.h"

#include <algorithm>
#include <string_view>

namespace forage::studio {

/// A file of the page, from the table that the build makes (cmake/StudioPage.cmake).
struct Asset {
    const char* path;
    const unsigned char *begin, *end;
    bool gzip;
};
extern const Asset assets[];
extern const int asset_count;

std::optional<Content> find_asset(const std::string& path) {
    const std::string_view name = path == "/" ? "/index.html" : std::string_view(path);
    const Asset* const end = assets + asset_count;
    const Asset* const found = std::find_if(assets, end, [&](const Asset& a) { return a.path == name; });
    if (found == end) return std::nullopt;
    constexpr std::pair<std::string_view, const char*> types[] = {{".html", "text/html; charset=utf-8"},
                                                                  {".js", "text/javascript; charset=utf-8"},
                                                                  {".css", "text/css; charset=utf-8"},
                                                                  {".png", "image/png"}};
    const char* type = "application/octet-stream";
    for (const auto& [ending, media] : types)
        if (std::string_view(found->path).ends_with(ending)) type = media;
    return Content{
        type,
        std::string(reinterpret_cast<const char*>(found->begin), reinterpret_cast<const char*>(found->end)),
        found->gzip};
}

}  // namespace forage::studio
