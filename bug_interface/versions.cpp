#include "bug_interface/versions.h"

#include <LinearMath/btScalar.h>
#include <opencv2/core/version.hpp>
#include <png.h>

namespace forage::bug {

std::vector<std::pair<std::string, std::string>> library_versions() {
    return {
        {"Bullet", std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100)},
        {"OpenCV", CV_VERSION},
        {"libpng", PNG_LIBPNG_VER_STRING}};
}

}  // namespace forage::bug
