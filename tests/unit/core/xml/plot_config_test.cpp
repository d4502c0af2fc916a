// The original's files of plots.
#include "core/xml/plot_config.h"

#include "tests/support/catch.h"

using namespace forage;

namespace {

/// A file with one window.
std::string with(const std::string& type, const std::string& inside) {
    return "<iqrDataManagerConfiguration>\n <DataClient type=\"" + type + "\" ID=\"a\">\n" + inside +
           "\n </DataClient>\n</iqrDataManagerConfiguration>\n";
}

}  // namespace

TEST_CASE("Windows of the original are read with their sources") {
    Diagnostics diagnostics;
    const auto windows = xml::parse_plot_config("x.conf", with("PlotTypeTime", R"(
  <Position x="1" y="2"/><Geometry width="3" height="4"/>
  <StateVariableDisplay>
   <StateVariableDisplays ID="1" itemID="g1" indices="0;1; 2"><Average>true</Average><SelectedStates>vm;act;</SelectedStates><Live>true</Live></StateVariableDisplays>
   <StateVariableDisplays ID="2" itemID="g2"/>
  </StateVariableDisplay>)"),
                                                diagnostics);
    INFO(format(diagnostics));
    REQUIRE(diagnostics.all().empty());
    REQUIRE(windows.size() == 1);
    CHECK(windows[0].kind == xml::PlotWindow::Kind::time);
    REQUIRE(windows[0].sources.size() == 2);
    CHECK(windows[0].sources[0].id == "g1");
    CHECK(windows[0].sources[0].states == std::vector<std::string>{"vm", "act"});
    CHECK(windows[0].sources[0].cells == std::vector<int>{0, 1, 2});
    CHECK(windows[0].sources[0].average);
    CHECK(windows[0].sources[1].cells.empty());
}

TEST_CASE("The settings of the original's sampler are read") {
    Diagnostics diagnostics;
    const auto windows = xml::parse_plot_config(
        "x.conf",
        with("DataSampler",
             "<AutoStart>true</AutoStart><ACQ_MODE>2</ACQ_MODE><TARGET_MODE>6</TARGET_MODE>"
             "<SamplingRate>5</SamplingRate><Amount>100</Amount><FileName>a b.dat</FileName>"),
        diagnostics);
    REQUIRE(diagnostics.all().empty());
    const auto& s = windows.at(0).sampler;
    CHECK((s.automatic && s.mode == "sequence" && s.every == 5 && s.rows == 100 && s.file == "a b.dat"));
    const auto continuous = xml::parse_plot_config(
        "x.conf", with("DataSampler", "<ACQ_MODE>1</ACQ_MODE><TARGET_MODE>5</TARGET_MODE><Amount>9</Amount>"),
        diagnostics);
    CHECK((!continuous.at(0).sampler.rows && continuous.at(0).sampler.mode == "append"));
}

TEST_CASE("What is not known in a file of plots is said with its place") {
    struct Example {
        std::string text, message;
        int line;
        bool error;
    };
    const auto e = GENERATE(values<Example>(
        {{with("PlotTypeNew", ""), "there is no window of type 'PlotTypeNew'; it is left out", 2, false},
         {with("PlotTypeTime", "\n<Colour>red</Colour>"), "<Colour> is left out", 4, false},
         {with("PlotTypeTime",
               "<StateVariableDisplay>\n<StateVariableDisplays itemID='g' "
               "indices='1;x'/></StateVariableDisplay>"),
          "the number of a cell is a whole number, not 'x'", 4, true},
         {with("PlotTypeTime", "<StateVariableDisplay><StateVariableDisplays/></StateVariableDisplay>"),
          "<StateVariableDisplays> needs itemID", 3, true},
         {with("DataSampler", "<TARGET_MODE>9</TARGET_MODE>"), "there is no way 9 to write a file", 3, false},
         {with("DataSampler", "<SamplingRate>fast</SamplingRate>"),
          "SamplingRate is a whole number, not 'fast'", 3, true},
         {"<HarborConfig/>", "<HarborConfig> is no configuration of plots", 1, true}}));
    Diagnostics diagnostics;
    xml::parse_plot_config("x.conf", e.text, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].message == e.message);
    CHECK(diagnostics.all()[0].where.line == e.line);
    CHECK(diagnostics.failed() == e.error);
}
