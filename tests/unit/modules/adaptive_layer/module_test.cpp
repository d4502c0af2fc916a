#include "modules/adaptive_layer/module.h"

#include <filesystem>
#include <fstream>
#include <random>

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using adaptive::AdaptiveLayerModule;

namespace {

struct AdaptiveBench : ModuleBench {
    AdaptiveBench() : ModuleBench(module_type<AdaptiveLayerModule>()) {}
};

/// CS 2 x 3, UR 4 x 1.
void bind(ModuleBench& b, bool display = true, int discrepancies = 1) {
    b.in("input", 2, 3)
        .in("condition", 4, 1)
        .out("prototype", 2, 3)
        .out("output", 4, 1)
        .out("descripancy", discrepancies, 1);
    if (display)
        b.out("weight display", 8, 3);
    else
        b.bind("weight display", true, 0, 0, 0);
    b.seed(1);
}

std::string temporary() {
    return (std::filesystem::temp_directory_path() / ("forage_al_" + std::to_string(std::random_device{}())))
        .string();
}

}  // namespace

TEST_CASE("moduleAL shows its weights as one picture of the stimulus per response, side by side") {
    AdaptiveBench b;
    bind(b);
    CHECK(b.problems().empty());
    b.start();
    b.update();
    const auto& w = b.module<AdaptiveLayerModule>().layer().weights();
    for (Index k = 0; k < 4; ++k)
        for (Index q = 0; q < 3; ++q)
            for (Index c = 0; c < 2; ++c) CHECK(b.outputs[3][q * 8 + k * 2 + c] == w(q * 2 + c, k));
}

TEST_CASE("moduleAL writes only the first cell of the discrepancy, and works without a display") {
    AdaptiveBench b;
    bind(b, false, 4);
    CHECK_THAT(only_problem(b), ContainsSubstring("'descripancy' needs 1 cell; 'P/descripancy' is 4 x 1") &&
                                    ContainsSubstring("--lenient accepts it"));
    b.start();
    b.update();
    CHECK(b.outputs[2][0] == 1);
    CHECK(b.outputs[2].sum() == 1);
}

TEST_CASE(
    "moduleAL begins with other weights for another seed, and with the same ones when it is started again") {
    AdaptiveBench b;
    bind(b);
    const auto first_weights = [&](std::uint64_t seed) {
        b.seed(seed).start();
        return b.module<AdaptiveLayerModule>().layer().weights();
    };
    const Eigen::MatrixXd one = first_weights(1), two = first_weights(2);
    CHECK(one != two);
    CHECK(first_weights(1) == one);
}

TEST_CASE("moduleAL reads its file at the end of an update and displays it in the next") {
    const std::string path = temporary();
    std::ofstream(path) << "1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4";
    AdaptiveBench b;
    bind(b);
    b.set("File Name", path).set("read", "true");
    CHECK(b.problems().empty());
    b.start();
    b.inputs[0].setConstant(0);
    b.update();
    CHECK(b.outputs[3].abs().maxCoeff() <= 0.1);
    CHECK_FALSE(b.module<AdaptiveLayerModule>().read);
    b.update();
    CHECK(b.outputs[3].head(8).matrix() == (Eigen::VectorXd(8) << 1, 1, 2, 2, 3, 3, 4, 4).finished());
    std::filesystem::remove(path);
}

TEST_CASE("moduleAL writes its file once per request") {
    const std::string path = temporary();
    AdaptiveBench b;
    bind(b);
    b.set("File Name", path).set("write", "true");
    b.start();
    b.update();
    CHECK(std::filesystem::exists(path));
    CHECK_FALSE(b.module<AdaptiveLayerModule>().write);
    std::filesystem::remove(path);
    b.update();
    CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("moduleAL reports a missing file before the run, or stops") {
    AdaptiveBench b;
    bind(b);
    b.set("read", "true");
    CHECK_THAT(only_problem(b), ContainsSubstring("'File Name' is empty"));
    b.set("File Name", "/no/such/file");
    CHECK_THROWS_WITH(b.problems(), ContainsSubstring("/no/such/file: there is no such file"));
    b.set("read", "false").start();
    b.set("read", "true");
    CHECK_THROWS_WITH(b.update(), ContainsSubstring("no such file"));
    b.update();
}

TEST_CASE("moduleAL reports groups of the wrong size and the required size") {
    const auto bound = [](AdaptiveBench& b, int proto_w, int proto_h, int display_w, int out_w) {
        b.in("input", 2, 3).in("condition", 4, 1).out("prototype", proto_w, proto_h).out("output", out_w, 1);
        b.out("descripancy", 1, 1).out("weight display", display_w, 3);
    };
    AdaptiveBench transposed, narrow, short_output, all;
    bound(transposed, 3, 2, 8, 4);
    CHECK_THAT(
        only_problem(transposed),
        ContainsSubstring("'prototype' needs the size of 'input'; 'P/prototype' is 3 x 2, 'P/input' 2 x 3"));
    bound(narrow, 2, 3, 7, 4);
    CHECK_THAT(
        only_problem(narrow),
        ContainsSubstring("'weight display' needs one picture of 'input' for each cell of 'condition'") &&
            ContainsSubstring("is 7 x 3") && ContainsSubstring("make the group 8 x 3"));
    bound(short_output, 2, 3, 8, 3);
    CHECK_THAT(only_problem(short_output), ContainsSubstring("make the group 4 x 1"));
    bound(all, 1, 1, 1, 1);
    CHECK(all.problems().size() == 3);
    AdaptiveBench sparse;
    sparse.bind("input", false, 4, 4, 3).in("condition", 4, 1).out("prototype", 2, 3).out("output", 4, 1);
    sparse.out("descripancy", 1, 1).out("weight display", 8, 3);
    CHECK_THAT(only_problem(sparse), ContainsSubstring("a full rectangle"));
}
