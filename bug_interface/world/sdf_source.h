// The files of a world while they are read: values of their elements, and what is wrong with them.
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include <sdf/sdf.hh>

#include "bug_interface/world/description.h"
#include "bug_interface/world/model_folders.h"
#include "bug_interface/world/sdf_parser.h"
#include "core/model/diagnostic.h"

namespace forage::bug {

/// What all readers of elements need. Their functions get it as `in`.
class SdfSource {
  public:
    SdfSource(const std::string& world, Diagnostics& diagnostics_, const std::vector<std::string>& extra)
        : diagnostics(diagnostics_), folders(world, extra), parser(diagnostics_) {}

    Location at(const std::string& file, int line) { return parser.at(file, line); }
    Location at(const sdf::ElementPtr& e) { return parser.at(e); }

    /// What element `name` in `parent` holds; `otherwise` without one. An error when it is not finite.
    template <class T>
    T value(const sdf::ElementPtr& parent, const std::string& name, T otherwise) {
        if (!parent->HasElement(name)) return otherwise;
        const auto e = parent->GetElement(name);
        T out = e->Get<T>();
        if constexpr (requires { out.IsFinite(); }) {
            if (!out.IsFinite()) return not_finite(e), otherwise;
        } else if constexpr (std::is_same_v<T, double>) {
            if (!std::isfinite(out)) return not_finite(e), otherwise;
        }
        return out;
    }
    /// The <pose> in `parent`.
    Pose pose_of(const sdf::ElementPtr& parent);
    /// The standard deviation of the <noise> in `e`.
    double noise_of(const sdf::ElementPtr& e);
    double rate_of(const sdf::ElementPtr& sensor);  ///< 1/s

    Diagnostics& diagnostics;
    ModelFolders folders;
    SdfParser parser;

  private:
    void not_finite(const sdf::ElementPtr& e);
    void check_angles(const sdf::ElementPtr& pose);
};

inline std::string name_of(const sdf::ElementPtr& e) {
    return e->HasAttribute("name") ? e->Get<std::string>("name") : std::string();
}

/// The element that a path of names leads to; null when there is none.
inline sdf::ElementPtr child(const sdf::ElementPtr& e, std::initializer_list<const char*> path) {
    sdf::ElementPtr at = e;
    for (const char* name : path) {
        if (!at->HasElement(name)) return nullptr;
        at = at->GetElement(name);
    }
    return at;
}

/// Calls visit(element) for the elements `name` in `parent`, in file order.
template <class F>
void each(const sdf::ElementPtr& parent, const std::string& name, F visit) {
    for (auto e = parent->GetFirstElement(); e; e = e->GetNextElement())
        if (e->GetName() == name) visit(e);
}

}  // namespace forage::bug
