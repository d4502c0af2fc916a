#include "bug_interface/world/sdf_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/world/sdf_schema.h"
#include "bug_interface/world/sdf_values.h"
#include "core/base/number.h"
#include "core/base/text_file.h"

namespace forage::bug {
namespace {

/// What an element holds, for a hint.
std::string expected(const xml::Element& e, Content content) {
    if (e.name == "size" && content == Content::two_numbers) return "a size is x y here: two numbers, in m";
    if (e.name == "size" && content == Content::three_numbers) return "a size is x y z: three numbers, in m";
    switch (content) {
        case Content::pose:
            return is_quaternion(e) ? "this pose is x y z qx qy qz qw: seven numbers"
                                    : "a pose is x y z roll pitch yaw: six numbers, in m and rad";
        case Content::colour:
            return "a colour is red green blue alpha, each from 0 to 1";
        case Content::two_numbers:
            return "two numbers with a space between them";
        case Content::three_numbers:
            return "three numbers with spaces between them";
        case Content::whole_number:
            return "a whole number is expected here";
        default:
            return "a number is expected here, with a point and without a unit";
    }
}

std::size_t count(const xml::Element& e, Content content) {
    switch (content) {
        case Content::pose:
            return size_of(e);
        case Content::colour:
            return 4;
        case Content::three_numbers:
            return 3;
        case Content::two_numbers:
            return 2;
        default:
            return 1;
    }
}

/// Where `part` of the text of `e` stands.
Location place_of(std::string_view part, const xml::Element& e) {
    Location out = e.text_where;
    const std::string_view before(e.text.data(), static_cast<std::size_t>(part.data() - e.text.data()));
    const auto line = before.rfind('\n');
    out.line += static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    out.column = line == before.npos ? out.column + static_cast<int>(before.size())
                                     : static_cast<int>(before.size() - line);
    return out;
}

class Check {
  public:
    explicit Check(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    /// What stands in `parent`, which may be called otherwise than its `kind`.
    void elements_of(const xml::Element& parent, std::string_view kind) {
        for (const xml::Element& e : parent.children) {
            if (e.name.find(':') != std::string::npos) continue;  // another program's own
            if (const auto content = content_of(e.name, kind))
                element(e, *content);
            else
                unknown(e, kind);
        }
    }

  private:
    void element(const xml::Element& e, Content content) {
        for (const std::string_view name : required_attributes(e.name))
            if (!e.attribute(name))
                diagnostics_.error(e.where, fmt::format("<{}> needs the attribute '{}'", e.name, name),
                                   fmt::format("<{} {}=\"...\">", e.name, name));
        for (const std::string_view name : required_children(e.name))
            if (!e.child(name))
                diagnostics_.error(e.where, fmt::format("<{}> needs a <{}>", e.name, name),
                                   fmt::format("<{0}><{1}>...</{1}></{0}>", e.name, name));
        if (content == Content::truth)
            check_truth(e);
        else if (content != Content::elements && content != Content::text && content != Content::anything)
            check_numbers(e, content);
        if (content != Content::anything) elements_of(e, e.name);
    }

    void unknown(const xml::Element& e, std::string_view parent) {
        const auto known = known_children(parent);
        const auto near = nearest(e.name, known);
        if (near.empty() && parent == "sdf") return;  // that the world is missing is said once
        diagnostics_.warning(e.where,
                             fmt::format("<{}> is not known in <{}> and has no effect", e.name, parent),
                             near.empty() ? std::string() : fmt::format("did you mean <{}>?", near));
    }

    void check_truth(const xml::Element& e) {
        if (e.text.empty())
            empty(e);
        else if (!truth(e.text))
            diagnostics_.error(e.where, fmt::format("<{}> cannot be '{}'", e.name, escaped(e.text)),
                               "write true or false");
    }

    void empty(const xml::Element& e) {
        diagnostics_.warning(e.where, fmt::format("<{}> is empty and has no effect", e.name));
    }

    void check_numbers(const xml::Element& e, Content content) {
        if (e.text.empty()) {
            if (content != Content::pose) empty(e);
            return;
        }
        const auto [values, wrong] = numbers(e.text);
        if (!wrong.empty()) return wrong_word(e, wrong, content);
        const std::size_t wanted = count(e, content);
        if (values.size() != wanted && !(content == Content::colour && values.size() == 3))
            return diagnostics_.error(
                e.where, fmt::format("<{}> has {} numbers instead of {}", e.name, values.size(), wanted),
                expected(e, content));
        if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
            return diagnostics_.error(e.where, fmt::format("<{}> holds a number that is not finite", e.name),
                                      expected(e, content));
        const auto outside = [](double v) { return !(v >= 0 && v <= 1); };
        if ((content == Content::whole_number && std::trunc(values[0]) != values[0]) ||
            (content == Content::colour && std::any_of(values.begin(), values.end(), outside)))
            diagnostics_.error(e.text_where, fmt::format("<{}> cannot be '{}'", e.name, escaped(e.text)),
                               expected(e, content));
    }

    void wrong_word(const xml::Element& e, std::string_view word, Content content) {
        const Location where = place_of(word, e);
        std::string_view rest = word;
        if (out_of_range(word))
            diagnostics_.error(where, no_number(word));
        else if (take_number<double>(rest))  // "1,5", "3m"
            diagnostics_.error(where, no_number(word), "numbers have a point, not a comma, and no unit");
        else
            diagnostics_.error(where, fmt::format("<{}> cannot be '{}'", e.name, escaped(e.text)),
                               expected(e, content));
    }

    Diagnostics& diagnostics_;
};

}  // namespace

void check_sdf(const xml::Element& root, Diagnostics& diagnostics) {
    if (root.name != "sdf" && root.name != "gazebo")  // the root of version 1.2
        return diagnostics.error(
            root.where,
            fmt::format("the root element is <{}>; that of a world or a model is <sdf>", root.name),
            root.name == "System" ? "this is a system file; a world holds the robot, its arena and the lights"
            : root.name == "experiment"
                ? "this is an experiment file; 'forage experiment' runs it"
                : "a world file is <sdf version=\"1.4\"><world name=\"..\">..</world></sdf>");
    const auto* version = root.attribute("version");
    if (!version)
        return diagnostics.error(root.where, "<sdf> needs the attribute 'version'", "<sdf version=\"1.4\">");
    const auto minor = sdf_version(version->value);
    if (!minor)
        return diagnostics.error(version->where,
                                 fmt::format("there is no version '{}' of SDF", escaped(version->value)),
                                 "<sdf version=\"1.4\">");
    if (*minor < 2)
        return diagnostics.error(
            version->where, fmt::format("version {} of SDF is not read, only 1.2 and later", version->value));
    Check(diagnostics).elements_of(root, "sdf");
}

}  // namespace forage::bug
