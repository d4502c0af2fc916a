#include "core/base/archive.h"

#include <bit>
#include <cmath>
#include <limits>

#include "core/types/module.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

enum class Mood { good, bad };

struct Part {
    int number = 0;
    std::string name;
    void checkpoint(Archive& archive) { archive(number, name); }
    friend bool operator==(const Part&, const Part&) = default;
};

/// One value of each kind.
struct All {
    bool flag = false;
    std::int8_t small = 0;
    std::uint64_t large = 0;
    double real = 0;
    Mood mood = Mood::good;
    std::string text;
    std::vector<double> numbers;
    std::vector<Part> parts;
    std::vector<std::vector<char>> nested;
    std::deque<int> queue;
    std::array<float, 3> fixed{};
    double plain[2] = {};
    std::map<std::string, Part> by_name;
    std::pair<int, bool> pair;
    std::optional<Part> some, none{Part{1, "to go"}};
    Eigen::MatrixXd matrix;
    Eigen::ArrayXf array;

    void checkpoint(Archive& a) {
        a(flag, small, large, real, mood, text, numbers, parts, nested, queue, fixed, plain, by_name, pair,
          some, none, matrix, array);
    }
};

All filled() {
    All a;
    a.flag = true, a.small = -3, a.large = ~0ull, a.real = -0.0, a.mood = Mood::bad;
    a.text = std::string("nul \0 and more", 14);
    a.numbers = {1, std::numeric_limits<double>::infinity(), 5e-324};
    a.parts = {{1, "one"}, {2, ""}};
    a.nested = {{}, {'a', 'b'}};
    a.queue = {4, 5, 6};
    a.fixed = {1, 2, 3};
    a.plain[1] = 7;
    a.by_name["x"] = {9, "nine"};
    a.pair = {8, true};
    a.some = Part{3, "three"};
    a.none.reset();
    a.matrix = Eigen::MatrixXd::Random(3, 4);
    a.array = Eigen::ArrayXf::Random(5);
    return a;
}

template <class T>
void describe_all(ModuleSpec<T>& s) {
    s.name("module", "Module");
    s.param("gain", &T::gain);
    s.param("on", &T::on);
    s.param("file", &T::file);
}

struct Parameters {
    static void describe(ModuleSpec<Parameters>& s) { describe_all(s); }
    void update(ModuleFrame&) {}
    double gain = 1;
    bool on = false;
    std::string file;
};
struct SmallSecret {
    static void describe(ModuleSpec<SmallSecret>& s) { describe_all(s); }
    void update(ModuleFrame&) {}
    double gain = 1;
    bool on = false, seen = false;
    std::string file;
};
struct LargeSecret {
    static void describe(ModuleSpec<LargeSecret>& s) { describe_all(s); }
    void update(ModuleFrame&) {}
    double gain = 1;
    bool on = false;
    std::string file;
    std::optional<std::vector<double>> memory;
};
struct SecretBetween {
    static void describe(ModuleSpec<SecretBetween>& s) { describe_all(s); }
    void update(ModuleFrame&) {}
    double gain = 1;
    std::optional<int> memory;
    std::string file;
    bool on = false;
};
struct Private {
    static void describe(ModuleSpec<Private>& s) { describe_all(s); }
    void update(ModuleFrame&) {}
    double gain = 1;
    bool on = false;
    std::string file;

  private:
    [[maybe_unused]] int count_ = 0;
};
struct Declared {
    static void describe(ModuleSpec<Declared>& s) { describe_all(s); }
    void update(ModuleFrame&) {}
    double gain = 1;
    bool on = false;
    std::string file;
    int count = 0;
    void checkpoint(Archive& archive) { archive(count); }
};

}  // namespace

TEST_CASE("Values of every kind are read back as they were written") {
    All all = filled();
    Archive out;
    out(all);
    All read;
    Archive in{std::string_view(out.bytes())};
    REQUIRE(in.loading());
    in(read);
    CHECK(in.left().empty());
    CHECK(std::signbit(read.real));
    CHECK(read.mood == Mood::bad);
    CHECK(read.text == all.text);
    CHECK(read.parts == all.parts);
    CHECK(read.by_name == all.by_name);
    CHECK(read.some == all.some);
    CHECK_FALSE(read.none);
    CHECK(read.matrix == all.matrix);
    Archive again;
    again(read);
    CHECK(again.bytes() == out.bytes());
}

TEST_CASE("An archive passes on to a sink what it would keep") {
    All all = filled();
    Archive out;
    out(all);
    std::string passed;
    Archive passing([&](std::string_view bytes) { passed += bytes; });
    passing(all);
    CHECK(passed == out.bytes());
    CHECK(passing.bytes().empty());
}

TEST_CASE("On request every NaN is written in the same way, and nothing else changes") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    const All random = filled();
    const auto written = [&](double a, Archive::Nan kind) {
        All all = random;
        all.real = a, all.numbers = {1, a, -0.0, -infinity}, all.plain[0] = a, all.matrix(1, 2) = a;
        all.fixed[1] = static_cast<float>(a), all.array[3] = static_cast<float>(a);
        Archive out(kind);
        out(all);
        return out.bytes();
    };
    using enum Archive::Nan;
    const auto other = std::bit_cast<double>(0xfff8000000000123u);
    CHECK(written(nan, as_it_is) != written(-nan, as_it_is));
    for (const double each : {-nan, other}) CHECK(written(each, all_the_same) == written(nan, as_it_is));
    for (const double each : {0.0, -0.0, 5e-324, -infinity, 1.5})
        CHECK(written(each, all_the_same) == written(each, as_it_is));
}

TEST_CASE("Bytes that end too early are refused, and so are sizes beyond the memory") {
    All all = filled();
    Archive out;
    out(all);
    for (std::size_t n = 0; n < out.bytes().size(); ++n) {
        Archive in(std::string_view(out.bytes()).substr(0, n));
        All read;
        CHECK_THROWS_AS(in(read), ArchiveError);
    }
    const std::string huge(16, '\xFF');
    std::vector<double> numbers;
    Eigen::MatrixXd matrix;
    CHECK_THROWS_AS(Archive(std::string_view(huge))(numbers), ArchiveError);
    CHECK_THROWS_AS(Archive(std::string_view(huge))(matrix), ArchiveError);
}

TEST_CASE("A wrong value is refused by name") {
    Archive out;
    out.same(3, "the size");
    Archive in{std::string_view(out.bytes())};
    CHECK_THROWS_WITH(in.same(4, "the size"), "the checkpoint is of something else: the size differs");
}

TEST_CASE("A module type with undeclared members is detected") {
    CHECK(module_type<Parameters>().checkpoints);
    CHECK(module_type<Declared>().checkpoints);
    CHECK_FALSE(module_type<SmallSecret>().checkpoints);
    CHECK_FALSE(module_type<LargeSecret>().checkpoints);
    CHECK_FALSE(module_type<SecretBetween>().checkpoints);
    CHECK_FALSE(module_type<Private>().checkpoints);
}
