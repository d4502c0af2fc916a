#include "core/types/parameter.h"

#include <array>
#include <clocale>
#include <cmath>
#include <limits>
#include <locale>

#include "tests/support/catch.h"

using namespace forage;

namespace {

struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// A locale in which numbers are written 0,5 and 1.000. The C++ locale is always set, the C locale where one
/// is installed.
class ForeignLocale {
  public:
    ForeignLocale()
        : before_(std::locale::global(std::locale(std::locale::classic(), new Commas))),
          c_before_(std::setlocale(LC_ALL, nullptr)) {
        for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"})
            if (std::setlocale(LC_ALL, name)) break;
    }
    ~ForeignLocale() {
        std::locale::global(before_);
        std::setlocale(LC_ALL, c_before_.c_str());
    }
    ForeignLocale(const ForeignLocale&) = delete;
    ForeignLocale& operator=(const ForeignLocale&) = delete;

  private:
    std::locale before_;
    std::string c_before_;
};

}  // namespace

TEST_CASE("A printed number is read back as the same number, whatever the locale") {
    const ForeignLocale locale;
    const auto number = GENERATE(0.0, -0.0, 0.1, 1.0 / 3, 1234567.891, -2.5, 1e-300, 1e300, 5e-324,
                                 std::numeric_limits<double>::max());
    const std::string text = to_text(ParameterValue(number));
    CHECK(text.find(',') == std::string::npos);
    const auto read = parse_parameter(ParameterKind::real, text);
    REQUIRE(read);
    CHECK(std::get<double>(*read) == number);
    CHECK(std::signbit(std::get<double>(*read)) == std::signbit(number));
}

TEST_CASE("Texts, whole numbers and booleans are read back as they were printed") {
    const ForeignLocale locale;
    const auto value =
        GENERATE(ParameterValue(true), ParameterValue(false), ParameterValue(0), ParameterValue(-1234567),
                 ParameterValue(std::numeric_limits<int>::max()), ParameterValue(std::string("a, b & c")));
    const ParameterKind kind = std::array{ParameterKind::boolean, ParameterKind::real, ParameterKind::integer,
                                          ParameterKind::text}[value.index()];
    CHECK(parse_parameter(kind, to_text(value)) == std::optional(value));
}

TEST_CASE("A decimal comma is not accepted, whatever the locale") {
    const ForeignLocale locale;
    CHECK_FALSE(parse_parameter(ParameterKind::real, "0,5"));
    CHECK(std::get<double>(*parse_parameter(ParameterKind::real, "0.5")) == 0.5);
    CHECK_FALSE(parse_parameter(ParameterKind::integer, "1.000"));
}

TEST_CASE("A text that is not a value of its kind is refused as a whole") {
    CHECK_FALSE(parse_parameter(ParameterKind::real, ""));
    CHECK_FALSE(parse_parameter(ParameterKind::real, " 1"));
    CHECK_FALSE(parse_parameter(ParameterKind::real, "1 "));
    CHECK_FALSE(parse_parameter(ParameterKind::real, "1x"));
    CHECK_FALSE(parse_parameter(ParameterKind::real, "nan"));
    CHECK_FALSE(parse_parameter(ParameterKind::real, "-inf"));
    CHECK_FALSE(parse_parameter(ParameterKind::real, "1e999"));
    CHECK_FALSE(parse_parameter(ParameterKind::integer, "1.5"));
    CHECK_FALSE(parse_parameter(ParameterKind::integer, "2147483648"));
    CHECK_FALSE(parse_parameter(ParameterKind::boolean, "True"));
    CHECK_FALSE(parse_parameter(ParameterKind::boolean, "1"));
    CHECK(parse_parameter(ParameterKind::text, ""));
}

TEST_CASE("Text that is nearly a value is corrected for a hint; other text is not") {
    CHECK(corrected(ParameterKind::real, "0,5") == "0.5");
    CHECK(corrected(ParameterKind::real, " 1 ") == "1");
    CHECK(corrected(ParameterKind::real, "+1e-3") == "1e-3");
    CHECK(corrected(ParameterKind::boolean, "TRUE") == "true");
    CHECK(corrected(ParameterKind::boolean, "0") == "false");
    CHECK(corrected(ParameterKind::integer, "1.5") == "");
    CHECK(corrected(ParameterKind::real, "1,000,000") == "");
    CHECK(corrected(ParameterKind::real, "fast") == "");
    CHECK(corrected(ParameterKind::real, "0.5") == "");  // nothing to correct
    CHECK(corrected(ParameterKind::text, " a ") == "");
}

TEST_CASE("The range of a parameter holds for numbers of both kinds, its ends included") {
    const std::optional<ParameterRange> range = ParameterRange{0, 10};
    CHECK_FALSE(outside(0.0, range));
    CHECK_FALSE(outside(10.0, range));
    CHECK(outside(10.000001, range));
    CHECK(outside(-1, range));
    CHECK(outside(11, range));
    CHECK_FALSE(outside(true, range));
    CHECK_FALSE(outside(std::string("11"), range));
    CHECK_FALSE(outside(11.0, std::nullopt));
}
