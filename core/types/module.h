// Module types: what connects groups to something else (a robot, a file, an algorithm).
//
// A module type is a plain struct whose members are its parameters. It has these functions, too:
//
//     static void describe(ModuleSpec<T>&);          // declares name, parameters, inputs and outputs
//     void check(const ModulePorts&, Diagnostics&);  // optional: reports mistakes that no size rule finds
//     void start(const ModulePorts&);                // optional: called once, before the first cycle
//     void start(const ModulePorts&, ModuleFrame&);  // instead of it: what it writes is received in cycle 0
//     void update(ModuleFrame&);                     // once per cycle, between groups and connections
//     void checkpoint(Archive&);                     // if there are other members (archive.h)
//
// A module reads the activity of its input groups in the same cycle. What it writes into an output is
// excitatory input of that group in the next cycle. An output keeps its values until it is written again.
//
// A module may have members that cannot be copied, such as a socket. It opens them in start(): Forage makes
// further objects of a type to check parameters, and destroys them without starting them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/archive.h"
#include "core/base/column.h"
#include "core/base/diagnostic.h"
#include "core/base/random.h"
#include "core/types/cell_names.h"
#include "core/types/members.h"
#include "core/types/parameter.h"
#include "core/types/type_error.h"

namespace forage {

class Environment;

/// What a module learns about its place in the system and about its run: the groups that are connected to its
/// ports, in order of declaration (an unset optional port has 0 cells), and the files of the run.
struct ModulePorts {
    struct Group {
        std::string port;  ///< the cross reference's name
        std::string path;  ///< "Process/Group"; empty when unset
        GroupShape shape;
    };
    std::string process;        ///< name of the process that holds the module
    std::vector<Group> inputs;  ///< in the order of declaration; with any_ports, in that of the file
    std::vector<Group> outputs;
    RandomStream random;                 ///< the module's own random stream
    Environment* environment = nullptr;  ///< core/run/environment.h; null in a run, or a check, without one

    // For start(); check() is called outside a run.
    std::string system;      ///< name of the system
    std::uint64_t seed = 0;  ///< of the run
    std::string directory;   ///< of the results, made before the first update; empty in a run without results
    /// Opens the file "Process_name" of the results, and replaces a file of an earlier run. What is written
    /// until the last cycle has ended is kept, and a resumed run continues the file where the checkpoint was
    /// written. The stream lives longer than the module; without a directory it forgets what is written.
    /// Throws std::runtime_error when the run has another file of that name, and std::logic_error after
    /// start().
    std::function<std::ostream&(const std::string& name)> open = [](const std::string&) -> std::ostream& {
        throw std::logic_error("a module opens its files in start(), in a run");
    };
};

/// The sizes of the groups at a module's ports, for size rules.
class PortSizes {
  public:
    explicit PortSizes(const ModulePorts& ports) : ports_(ports) {}
    /// The size of the group at an input or, when no input has this name, at an output. 1 x 1 for an unset
    /// port; a rule that reads the size of an unset port has no effect.
    GroupShape operator[](std::string_view port) {
        const auto* group = find(port);
        if (!group) return complete_ = false, GroupShape{1, 1, 1};
        if (std::find(read_.begin(), read_.end(), group) == read_.end()) read_.push_back(group);
        return group->shape;
    }
    bool has(std::string_view port) const { return find(port) != nullptr; }  ///< whether the port is set
    bool complete() const { return complete_; }  ///< whether all ports that were read are set
    const std::vector<const ModulePorts::Group*>& read() const { return read_; }  ///< in the order of reading

  private:
    const ModulePorts::Group* find(std::string_view port) const {
        for (const auto* side : {&ports_.inputs, &ports_.outputs})
            for (const auto& group : *side)
                if (group.port == port && group.shape.cells > 0) return &group;
        return nullptr;
    }
    const ModulePorts& ports_;
    std::vector<const ModulePorts::Group*> read_;
    bool complete_ = true;
};

/// What a port requires of the size of its group. It is declared once and used by `forage types`, by the
/// check of a system and by the documentation.
struct SizeRule {
    std::string text;  ///< completes "needs ...": "32 x 1 cells", "the size of 'input'"; empty: any size fits
    /// Returns `given`, the size of the group, when it fits, and otherwise a size that does. `module` holds
    /// the parameters.
    std::function<GroupShape(const void* module, PortSizes&, const GroupShape& given)> nearest;
    /// Whether a size that does not fit is only a warning when a system is read leniently, because the
    /// original accepts it. Null when it never is.
    std::function<bool(PortSizes&, const GroupShape& given)> tolerates;
};

/// A cross reference that a module declares, to which a file connects one group.
struct ModulePort {
    std::string name;        ///< as in the file's `<XRef name="..">`
    std::string label;       ///< as shown to users
    bool is_output = false;  ///< written by the module (`<XRefHolder name="OutputToGroup">`)
    bool optional = false;   ///< may be absent or unset; the original refuses a system with an unset one
    std::string doc;         ///< sentences that say what the cells mean
    SizeRule size;
    /// What the cells of its group stand for; null: nothing is known. `module` holds the parameters.
    std::function<CellNames(const void* module, const ModulePorts&, const GroupShape&)> names = {};
    std::string like = {};  ///< another port, whose cells stand for the same
    /// Two other ports: the group has a picture of the first one's cells for each cell of the second, side by
    /// side.
    std::string picture = {}, each = {};
};

/// A full rectangle of cells. Sides and areas above 2^31 - 1 become that number.
inline GroupShape rectangle(std::int64_t width, std::int64_t height) {
    constexpr std::int64_t most = 2147483647;
    width = std::min(width, most), height = std::min(height, most);
    return {static_cast<int>(width), static_cast<int>(height),
            static_cast<int>(std::min(width * height, most))};
}

/// The inputs and outputs of a module in one cycle.
class ModuleFrame {
  public:
    /// `written[port]` becomes true when output() is called for `port`. `read[port]` says whether that output
    /// is read in this run; without the list, every output is.
    ModuleFrame(std::uint64_t cycle, const std::vector<ConstColumn>& in, const std::vector<Column>& out,
                std::vector<char>* written = nullptr, const std::vector<char>* read = nullptr)
        : cycle_(cycle), in_(in), out_(out), written_(written), read_(read) {}
    std::uint64_t cycle() const { return cycle_; }
    const ConstColumn& input(std::size_t port) const {  ///< activity of this cycle
        return in_[declared("input", port, in_.size())];
    }
    /// The excitation that the port's group receives in the next cycle. An output keeps its values until
    /// output() is called for it again, so call output() only in cycles in which the values change.
    Column output(std::size_t port) const {
        declared("output", port, out_.size());
        if (written_) (*written_)[port] = 1;
        return out_[port];
    }
    Index output_size(std::size_t port) const {  ///< number of cells; 0 for an unset port
        return out_[declared("output", port, out_.size())].size();
    }
    /// Whether an output is read in this run: false for a port that is unset or whose group is pruned. The
    /// answer is the same from start() to the last update. With it a module can save the cost of an output
    /// that is not read; writing such an output is harmless.
    bool is_read(std::size_t port) const { return output_size(port) > 0 && (!read_ || (*read_)[port]); }
    std::size_t inputs() const { return in_.size(); }
    std::size_t outputs() const { return out_.size(); }

  private:
    static std::size_t declared(const char* what, std::size_t port, std::size_t ports) {
        if (port >= ports) detail::not_declared(what, static_cast<long long>(port), ports);
        return port;
    }

    std::uint64_t cycle_;
    const std::vector<ConstColumn>& in_;
    const std::vector<Column>& out_;
    std::vector<char>* written_;
    const std::vector<char>* read_;
};

/// A module of a running system.
class ModuleInstance {
  public:
    virtual ~ModuleInstance() = default;
    virtual void* parameters() = 0;
    virtual void check(const ModulePorts&, Diagnostics&) = 0;
    virtual void start(const ModulePorts&, ModuleFrame&) = 0;
    virtual void update(ModuleFrame&) = 0;
    /// Reads or writes the members beside the parameters that change while the system runs.
    virtual void checkpoint(Archive&) = 0;
};

struct ModuleType {
    std::string name, label, doc;
    std::vector<Parameter> parameters;
    std::vector<ModulePort> ports;
    bool any_ports = false;   ///< whether the ports are those that the file names, in file order
    bool checkpoints = true;  ///< whether it has a checkpoint(Archive&), or no members beside its parameters
    std::function<std::unique_ptr<ModuleInstance>()> make;
};

/// Declares one port of module type T. Without a size rule, the group may have any size.
template <class T>
class PortBuilder {
  public:
    PortBuilder(std::vector<ModulePort>& all, std::size_t index) : all_(all), index_(index) {}
    PortBuilder& label(std::string text) { return port().label = std::move(text), *this; }
    PortBuilder& doc(std::string text) { return port().doc = std::move(text), *this; }
    PortBuilder& optional() { return port().optional = true, *this; }
    PortBuilder& size(int width, int height) {
        return size(std::to_string(width) + " x " + std::to_string(height) + " cells",
                    [=](const T&, PortSizes&, const GroupShape&) { return rectangle(width, height); });
    }
    /// The group has n cells, in any shape.
    PortBuilder& cells(int n) {
        return size(std::to_string(n) + (n == 1 ? " cell" : " cells"),
                    [=](const T&, PortSizes&, const GroupShape& given) {
                        return given.cells == n ? given : rectangle(n, 1);
                    });
    }
    PortBuilder& full_rectangle() {
        return size("a full rectangle", [](const T&, PortSizes&, const GroupShape& given) {
            return rectangle(given.width, given.height);
        });
    }
    /// The group has the size of the group at another port, as PortSizes finds it, and cells that stand for
    /// the same.
    PortBuilder& same_size_as(std::string other) {
        port().like = other;
        std::string text = "the size of '" + other + "'";
        return size(std::move(text), [other = std::move(other)](const T&, PortSizes& of, const GroupShape&) {
            const GroupShape shape = of[other];
            return rectangle(shape.width, shape.height);
        });
    }
    /// A rule of one's own: `nearest(module, sizes, given)`, as in SizeRule.
    template <class Nearest>
    PortBuilder& size(std::string text, Nearest nearest) {
        port().size.text = std::move(text);
        port().size.nearest = [nearest = std::move(nearest)](const void* module, PortSizes& of,
                                                             const GroupShape& given) {
            return nearest(*static_cast<const T*>(module), of, given);
        };
        return *this;
    }
    /// What the cells stand for: `names(module, ports, shape)` returns CellNames.
    template <class Names>
    requires requires(const Names& f, const T& m, const ModulePorts& p, const GroupShape& s) { f(m, p, s); }
    PortBuilder& names(Names names) {
        port().names = [names = std::move(names)](const void* module, const ModulePorts& ports,
                                                  const GroupShape& shape) -> CellNames {
            return names(*static_cast<const T*>(module), ports, shape);
        };
        return *this;
    }
    /// A name for each cell of a row, or of a column when the group has only one.
    PortBuilder& names(std::vector<std::string> all) {
        return names([all = std::move(all)](const T&, const ModulePorts&, const GroupShape& shape) {
            return shape.width > 1 || all.size() == 1 ? CellNames{.columns = all} : CellNames{.rows = all};
        });
    }
    /// The group has a picture of the cells at `port` for each cell at `each`, side by side, and their names.
    PortBuilder& pictures(std::string port_name, std::string each) {
        port().picture = std::move(port_name), port().each = std::move(each);
        return *this;
    }
    /// Sizes that the original accepts although they do not fit: `accepts(sizes, given)`.
    template <class Accepts>
    PortBuilder& tolerate(Accepts accepts) {
        return port().size.tolerates = std::move(accepts), *this;
    }

  private:
    ModulePort& port() { return all_[index_]; }
    std::vector<ModulePort>& all_;
    std::size_t index_;
};

template <class T>
class ModuleSpec {
  public:
    explicit ModuleSpec(ModuleType& type) : type_(type) {}
    ModuleSpec& name(std::string name, std::string label) {
        return type_.name = std::move(name), type_.label = std::move(label), *this;
    }
    ModuleSpec& doc(std::string text) { return type_.doc = std::move(text), *this; }
    template <class M>
    ParameterBuilder param(std::string name, M T::*member) {
        type_.parameters.push_back(detail::make_parameter<T>(std::move(name), member));
        return {type_.parameters, type_.parameters.size() - 1};
    }
    PortBuilder<T> input(std::string name, std::string label) {
        return port(std::move(name), std::move(label), false);
    }
    PortBuilder<T> output(std::string name, std::string label) {
        return port(std::move(name), std::move(label), true);
    }
    ModuleSpec& any_ports() { return type_.any_ports = true, *this; }

  private:
    PortBuilder<T> port(std::string name, std::string label, bool is_output) {
        ModulePort p;
        p.name = std::move(name);
        p.label = std::move(label);
        p.is_output = is_output;
        type_.ports.push_back(std::move(p));
        return {type_.ports, type_.ports.size() - 1};
    }
    ModuleType& type_;
};

namespace detail {

template <class T>
class ModuleModel final : public ModuleInstance {
  public:
    template <class... Prototype>
    explicit ModuleModel(const Prototype&... copied) : value_{copied...} {}
    void* parameters() override { return &value_; }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) override {
        if constexpr (requires { value_.check(ports, diagnostics); }) value_.check(ports, diagnostics);
    }
    void start(const ModulePorts& ports, ModuleFrame& frame) override {
        if constexpr (requires { value_.start(ports, frame); })
            value_.start(ports, frame);
        else if constexpr (requires { value_.start(ports); })
            value_.start(ports);
    }
    void update(ModuleFrame& frame) override { value_.update(frame); }
    void checkpoint(Archive& archive) override {
        if constexpr (requires { value_.checkpoint(archive); }) value_.checkpoint(archive);
    }

  private:
    T value_;
};

}  // namespace detail

/// Reports the groups that do not fit the size rules of their ports. `module` is an instance's parameters().
void check_sizes(const ModuleType& type, const ModulePorts& ports, const void* module,
                 Diagnostics& diagnostics);

/// The descriptor of module type T. Every module of a system starts as T{}.
template <class T>
ModuleType module_type() {
    static_assert(
        requires(T t, ModuleFrame & f) { t.update(f); }, "a module type needs void update(ModuleFrame&)");
    ModuleType type;
    ModuleSpec<T> spec(type);
    T::describe(spec);
    type.checkpoints = requires(T t, Archive a) { t.checkpoint(a); }
    || only_parameters<T>(type.parameters);
    type.make = [] { return std::make_unique<detail::ModuleModel<T>>(); };
    return type;
}

/// As above, but every module starts as a copy of `prototype`, which holds values that are not parameters,
/// such as the content of a file.
template <class T>
ModuleType module_type(const T& prototype) {
    ModuleType type = module_type<T>();
    type.make = [prototype] { return std::make_unique<detail::ModuleModel<T>>(prototype); };
    return type;
}

}  // namespace forage
