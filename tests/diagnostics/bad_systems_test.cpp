// The messages for mistakes in systems. Each file of bad_systems/ contains one mistake, and NAME.expect is
// the complete output for it. FORAGE_REWRITE_EXPECTATIONS=1 rewrites the expected outputs; read them as a
// user would before you keep them.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>

#include <sys/resource.h>

#include "core/connectivity/connect.h"
#include "core/equations/declared_types.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/xml/reader.h"
#include "neurons/linear_threshold.h"
#include "neurons/random_spike.h"
#include "synapses/fixed_weight.h"
#include "tests/support/catch.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

using namespace forage;
namespace fs = std::filesystem;

namespace {

struct TestModule {
    int gain = 1;
    static void describe(ModuleSpec<TestModule>& s) {
        s.name("moduleTest", "Test");
        s.param("gain", &TestModule::gain).label("Gain").range(0, 100).doc("Factor of the input.");
        s.input("_in", "Where it reads");
        s.output("_out", "Where it writes").size(3, 2);
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const {
        if (gain == 13)
            diagnostics.error(at_parameter("gain"), "a gain of 13 brings bad luck to " + ports.process,
                              "choose another");
    }
    void update(ModuleFrame&) {}
};

struct ProbeSynapse {
    static void describe(SynapseSpec<ProbeSynapse>& s) {
        s.name("synapseProbe", "Probe")
            .output("psp", "Postsynaptic potential")
            .feedback("postact", "Activity of the target");
    }
    double output(double) const { return 0; }
};

/// A small and fixed set of types, so that types that are added later do not change the messages.
Registry types() {
    Registry registry;
    registry.add(neuron_type<LinearThreshold>());
    registry.add(neuron_type<RandomSpike>());
    registry.add(synapse_type<FixedWeight>());
    registry.add(module_type<TestModule>());
    registry.add(synapse_type<ProbeSynapse>());
    return registry;
}

/// All diagnostics of the file before the first cycle, in the order in which a run finds them.
std::string answer(const fs::path& path, bool lenient = false) {
    Diagnostics diagnostics;
    diagnostics.lenient = lenient;
    const auto system = xml::read_system(path.string(), diagnostics);
    if (system) {
        Registry all = types();
        equations::add_types(*system, all, diagnostics);
        model::validate(*system, all, diagnostics);
    }
    if (system && !diagnostics.failed()) {
        const model::GroupIndex groups(*system);
        for (const auto& c : system->connections)
            connectivity::connect(c, groups.find(c.source).group->topology,
                                  groups.find(c.target).group->topology, 1, diagnostics);
    }
    std::string text = format(diagnostics);
    const std::string folder = path.parent_path().string() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
        text.erase(at, folder.size());
    return text;
}

fs::path corpus() { return test::source_dir() / "tests" / "diagnostics" / "bad_systems"; }

void compare(const std::string& name, const std::string& said) {
    const fs::path expected = corpus() / (name + ".expect");
    if (std::getenv("FORAGE_REWRITE_EXPECTATIONS")) std::ofstream(expected, std::ios::binary) << said;
    REQUIRE(fs::exists(expected));
    CHECK(said == test::read_text(expected));
    CHECK(said != "");
}

/// Writes `text` to a file that is removed at the end of the scope.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text)
        : folder_(fs::temp_directory_path() / ("forage_diagnostics_" + std::to_string(std::rand()))) {
        fs::create_directories(folder_);
        std::ofstream(path_ = folder_ / name, std::ios::binary) << text;
    }
    ~TemporaryFile() { fs::remove_all(folder_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path folder_, path_;
};

/// The processor time, which does not depend on other load of the machine.
double seconds_of(const std::function<void()>& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

#ifdef FORAGE_SANITIZED
constexpr double patience = 10;  // factor by which instrumented programs may be slower
#else
constexpr double patience = 1;
#endif

const std::string begin = "<System id=\"s\" name=\"S\" author=\"\" date=\"\" cylesPerSecond=\"0\">";

std::string repeated(std::string_view text, std::size_t times) {
    std::string out;
    for (std::size_t i = 0; i < times; ++i) out += text;
    return out;
}

}  // namespace

TEST_CASE("Every mistake gives the expected message within a second") {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(corpus()))
        if (entry.path().extension() == ".iqr") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    REQUIRE(files.size() >= 60);
    for (const auto& file : files) {
        INFO(file.filename().string());
        std::string said;
        CHECK(seconds_of([&] { said = answer(file); }) < patience);
        compare(file.stem().string(), said);
    }
}

// These inputs are not kept as files because they are large.
TEST_CASE("Files made to exhaust the reader are refused or read within a second") {
    const std::vector<std::pair<std::string, std::string>> hostile{
        {"nested_very_deeply", begin + repeated("<Process>", 300'000)},
        {"nested_very_deeply_in_text_only", repeated("<a>", 1'000'000)},
        {"attribute_of_five_megabytes",
         begin + "<Process id=\"p\" name=\"P\" " + std::string(5'000'000, 'x') + "=\"1\"/></System>"},
        {"value_of_five_megabytes", begin + "<Process id=\"p\" name=\"P\" enableModule=\"" +
                                        std::string(5'000'000, 'x') + "\"/></System>"},
        {"a_hundred_thousand_mistakes", begin + repeated("\n<Proces/>", 100'000) + "</System>"},
        {"a_hundred_thousand_attributes", begin + "<Process " +
                                              [] {
                                                  std::string out;
                                                  for (int i = 0; i < 100'000; ++i)
                                                      out += "a" + std::to_string(i) + "=\"\" ";
                                                  return out;
                                              }() +
                                              "/></System>"},
    };
    for (const auto& [name, text] : hostile) {
        INFO(name);
        const TemporaryFile file(name + ".iqr", text);
        std::string said;
        CHECK(seconds_of([&] { said = answer(file.path()); }) < patience);
        compare(name, said);
    }
}

TEST_CASE("The message about a missing file names the file that was probably meant") {
    compare("no_such_file", answer(corpus() / "no_such_flie.iqr"));
    compare("misspelt_file", answer(corpus() / "missing_qoute.iqr"));
}

TEST_CASE("Lenient reading turns what the original ignores into warnings, and nothing else") {
    for (const std::string name :
         {"parameter_unknown", "unknown_attribute_beside_the_others", "stray_text", "unknown_element",
          "list_point_0", "unknown_function", "module_groups_with_two_writers"})
        compare(name + ".lenient", answer(corpus() / (name + ".iqr"), true));
}

// Sanitizers delay the release of memory.
#ifndef FORAGE_SANITIZED
TEST_CASE("No mistake costs much memory") {
    for (const auto& entry : fs::directory_iterator(corpus()))
        if (entry.path().extension() == ".iqr") answer(entry.path());
    rusage usage{};
    REQUIRE(getrusage(RUSAGE_SELF, &usage) == 0);
    CHECK(usage.ru_maxrss < 200 * 1024);  // kB, of this program until now
}
#endif
