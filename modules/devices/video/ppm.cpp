#include "modules/devices/video/ppm.h"

#include <stdexcept>

#include "core/base/number.h"

namespace forage::video {
namespace {

constexpr std::size_t longest_header = 64;  // bytes

bool blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

}  // namespace

std::optional<Picture> PpmStream::next() {
    const auto broken = [] { return std::runtime_error("what ffmpeg writes is not a picture"); };
    const std::string_view text = std::string_view(bytes_).substr(at_);
    std::string_view left = text;
    std::string_view words[4];  // P6, width, height, 255
    for (auto& word : words) {
        while (!left.empty() && blank(left.front())) left.remove_prefix(1);
        std::size_t size = 0;
        while (size < left.size() && !blank(left[size])) ++size;
        if (size == left.size() || size == 0) {
            if (text.size() > longest_header) throw broken();
            return std::nullopt;
        }
        word = left.substr(0, size);
        left.remove_prefix(size);
    }
    left.remove_prefix(1);
    const auto width = parse_number<int>(words[1]), height = parse_number<int>(words[2]);
    if (words[0] != "P6" || words[3] != "255" || !width || !height || *width < 1 || *height < 1 ||
        *width > longest_side || *height > longest_side)
        throw broken();
    Picture out{*width, *height, {}};
    const std::size_t size = 3 * static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
    if (left.size() < size) return std::nullopt;
    out.rgb.assign(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(size));
    at_ = bytes_.size() - left.size() + size;
    if (at_ > bytes_.size() / 2) bytes_.erase(0, at_), at_ = 0;
    return out;
}

}  // namespace forage::video
