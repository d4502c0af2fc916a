// Tries two thousand damaged files, the same in every run: reading, checking and connecting never crash,
// never throw, and never make a synapse between cells that do not exist.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <random>
#include <vector>

#include "tests/fuzz/pipeline.h"
#include "tests/support/catch.h"
#include "tests/support/golden.h"
#include "tests/support/model_text.h"
#include "tests/support/paths.h"

using namespace forage;
namespace fs = std::filesystem;

namespace {

/// Damages texts; the same seed gives the same damage with any standard library.
class Mutator {
  public:
    Mutator(std::uint64_t seed, const std::vector<std::string>& sound, const std::vector<std::string>& broken)
        : random_(seed), sound_(sound), broken_(broken) {}

    std::string next() {
        const bool whole = below(4) > 0;
        std::string text = pick(whole ? sound_ : broken_);
        // A text that is not XML does not get past the parser; changed values get farthest.
        if (whole && below(2)) {
            for (std::size_t n = 1 + below(3); n > 0; --n) value(text, below(text.size()));
        } else {
            for (std::size_t n = 1 + below(3); n > 0; --n) damage(text);
        }
        return text;
    }

  private:
    std::size_t below(std::size_t n) {
        return n ? static_cast<std::size_t>(random_() % n) : 0;
    }  // the bias does not matter here
    const std::string& pick(const std::vector<std::string>& from) { return from[below(from.size())]; }

    void damage(std::string& text) {
        const std::size_t at = below(text.size() + 1), length = std::min(below(40), text.size() - at);
        switch (below(8)) {
            case 0:
                if (at < text.size()) text[at] = static_cast<char>(random_());
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(at, length));
                break;
            case 3:
                text.resize(at);
                break;
            case 4: {
                const std::string& other = pick(below(2) ? sound_ : broken_);
                text.insert(at, other.substr(below(other.size() + 1), below(400)));
                break;
            }
            case 5:
                text.insert(at, pick(tokens()));
                break;
            default:
                value(text, at);
                break;
        }
    }

    /// Gives the next attribute another value.
    void value(std::string& text, std::size_t at) {
        const auto begin = text.find("=\"", at);
        const auto end = begin == std::string::npos ? begin : text.find('"', begin + 2);
        if (end != std::string::npos) text.replace(begin + 2, end - begin - 2, pick(values()));
    }

    static const std::vector<std::string>& tokens() {
        static const std::vector<std::string> all{"<",
                                                  ">",
                                                  "/>",
                                                  "\"",
                                                  "&",
                                                  "&amp;",
                                                  "&#0;",
                                                  "<!--",
                                                  "-->",
                                                  "<![CDATA[",
                                                  "]]>",
                                                  "<!DOCTYPE",
                                                  "<?",
                                                  "\xff",
                                                  "\xef\xbb\xbf",
                                                  "<All/>",
                                                  "<List/>",
                                                  "<Note/>",
                                                  "<Group id=\"z\" name=\"Z\"/>",
                                                  "<Point x=\"0\" y=\"0\"/>",
                                                  "</Group>",
                                                  "</Process>",
                                                  "\r\n",
                                                  "\t"};
        return all;
    }
    static const std::vector<std::string>& values() {
        static const std::vector<std::string> all{"0",
                                                  "-1",
                                                  "1",
                                                  "2",
                                                  "7",
                                                  "99",
                                                  "100000",
                                                  "1000000",
                                                  "1e9",
                                                  "-2147483648",
                                                  "2147483647",
                                                  "2147483648",
                                                  "1e308",
                                                  "-1e308",
                                                  "1e-320",
                                                  "nan",
                                                  "inf",
                                                  "",
                                                  "true",
                                                  "false",
                                                  "RF",
                                                  "PF",
                                                  "center",
                                                  "all",
                                                  "inhibitory",
                                                  "0.5",
                                                  "1.5",
                                                  "100",
                                                  "3",
                                                  " ",
                                                  "&lt;",
                                                  "\xc3\xa9",
                                                  "neuronRandomSpike",
                                                  "synapseHebbian"};
        return all;
    }

    std::mt19937_64 random_;
    const std::vector<std::string>&sound_, &broken_;
};

std::vector<std::string> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".iqr" && entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> out;
    for (const auto& file : files) out.push_back(test::read_text(file));
    return out;
}

/// The systems that ship, with their modules (which this test does not know) disabled, and the small one in
/// variants.
std::vector<std::string> sound_files() {
    std::vector<std::string> out = files_in(test::source_dir() / "systems");
    for (std::string& text : out)
        for (auto at = text.find("enableModule=\"true\""); at != std::string::npos;
             at = text.find("enableModule=\"true\"", at))
            text.replace(at, 19, "enableModule=\"false\"");
    for (std::string& text : files_in(test::source_dir() / "systems" / "cookbook"))  // with elements left out
        if (text.find("<Module") == std::string::npos) out.push_back(std::move(text));
    const std::string arbor =
        "<ArbEllipseWindow innerwidth=\"1\" innerheight=\"2\" outerwidth=\"3\" outerheight=\"4\" "
        "direction=\"PF\" initialization_probability=\"0.5\"/>";
    const std::string pattern =
        "<PatternForeach><Region xstart=\"1\" ystart=\"2\" width=\"3\" height=\"1\"/><List><Point x=\"2\" "
        "y=\"3\"/></List></PatternForeach>";
    const std::vector<std::string> patterns{
        pattern,
        "<PatternMapped type=\"all\"><All/><Region xstart=\"2\" ystart=\"3\" width=\"2\" "
        "height=\"1\"/></PatternMapped>",
        "<PatternForeach><All/><All/></PatternForeach>",
        "<PatternTuples><Tuple><SourceList><Point x=\"1\" y=\"2\"/></SourceList><TargetList><Point x=\"5\" "
        "y=\"4\"/></TargetList></Tuple></PatternTuples>"};
    const std::vector<std::string> arbors{
        arbor, "<ArbRect width=\"3\" height=\"2\" direction=\"RF\" initialization_probability=\"1\"/>",
        "<ArbAll direction=\"PF\" initialization_probability=\"1\"/>",
        "<ArbRandom count=\"2\" direction=\"RF\" initialization_probability=\"1\"/>"};
    for (const auto& p : patterns)
        for (const auto& a : arbors)
            out.push_back(test::replaced(
                test::replaced(test::replaced(test::small_system, "moduleTest", "moduleNone"), pattern, p),
                arbor, a));
    return out;
}

}  // namespace

TEST_CASE("No damaged file crashes the reader, the checks or the connections") {
    const auto sound = sound_files(),
               broken = files_in(test::source_dir() / "tests" / "diagnostics" / "bad_systems");
    const Registry registry = test::shipped_types();
    Mutator mutator(20260101, sound, broken);
    int read = 0, checked = 0;
    std::size_t synapses = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::string text = mutator.next();
        INFO("mutation " << i << ":\n" << text.substr(0, 4000));
        test::PipelineResult result;
        REQUIRE_NOTHROW(result = test::run_pipeline(text, registry, i % 2 == 1));
        read += result.read, checked += result.checked, synapses += result.synapses;
    }
    // Damage that never gets past the parser would test little.
    CHECK(read > 200);
    CHECK(checked > 100);
    CHECK(synapses > 1000);
}
