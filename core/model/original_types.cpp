#include "core/model/original_types.h"

#include <algorithm>

namespace forage::model {
namespace {

constexpr std::string_view without_robot =
    "use moduleGazeboBug and a world, moduleReplay for recorded data, or write a module for the device "
    "(docs/how-to/write-a-module.md); enableModule=\"false\" keeps it in the file";
constexpr std::string_view as_video =
    "use moduleVideo, which reads cameras, films and folders of pictures (docs/how-to/video-and-gamepad.md)";
constexpr std::string_view without_motor =
    "use moduleVideo for the picture, and write a module for the motor (docs/how-to/write-a-module.md)";

constexpr std::string_view as_own_type =
    "write it as a type of your own (docs/how-to/write-a-neuron.md), or use neuronIntegrateFire or "
    "neuronLinearThreshold, which are the nearest types that ship";

constexpr OriginalType types[] = {
    {"moduleBttvVideo", "its interface to grabber cards is gone from Linux", as_video},
    {"moduleBttvVideoColor", "its interface to grabber cards is gone from Linux", as_video},
    {"moduleEPuck", "it drives an e-puck robot over a serial line", without_robot},
    {"moduleEPuckAdvanced", "it drives an e-puck robot over a serial line", without_robot},
    {"moduleEpuck", "it drives an e-puck robot over a serial line", without_robot},
    {"moduleKhepera", "it drives a Khepera robot over a serial line", without_robot},
    {"moduleKoalaW", "it drives a Koala robot over a radio link", without_robot},
    {"moduleLegoMindStorm", "it drives a Lego RCX brick, which is no longer made", without_robot},
    {"moduleSonyPanTilt", "it drives a Sony pan-tilt camera over a serial line", without_motor},
    {"moduleUSBVideo", "its interface to cameras (Video4Linux 1) is gone from Linux", as_video},
    {"moduleUSBVideoColor", "its interface to cameras (Video4Linux 1) is gone from Linux", as_video},
    {"moduleUSBVideoColorPT", "its interface to cameras (Video4Linux 1) is gone from Linux", without_motor},
    {"moduleUSBVideoPT", "its interface to cameras (Video4Linux 1) is gone from Linux", without_motor},
    {"moduleUSBVideoQC", "its interface to cameras (Video4Linux 1) is gone from Linux", as_video},
    {"moduleUSBVideoQCColor", "its interface to cameras (Video4Linux 1) is gone from Linux", as_video},
    {"moduleV4L2Color", "it is an earlier form of moduleVideo, with colours", as_video},
    {"moduleV4L2Monochrome", "it is an earlier form of moduleVideo, without colours", as_video},
    {"moduleV4L2Video", "it is an earlier form of moduleVideo, with one output", as_video},
    {"neuronIFadaptingTH", "it is an integrate and fire neuron with a threshold that adapts", as_own_type},
    {"neuronLTShuntingInhib", "it is a linear threshold neuron with shunting inhibition", as_own_type},
    {"openCVmpeg", "it plays a film, which moduleVideo does, too",
     "use moduleVideo with the parameter 'File Name', and its output 'videoOutputRed'"},
};

}  // namespace

std::span<const OriginalType> missing_original_types() { return types; }

const OriginalType* find_missing_original_type(std::string_view name) {
    const auto it =
        std::find_if(std::begin(types), std::end(types), [&](const auto& t) { return t.name == name; });
    return it == std::end(types) ? nullptr : it;
}

}  // namespace forage::model
