#include "modules/contextual_layer/contextual_layer.h"

#include <random>

#include "tests/support/catch.h"

using namespace forage::contextual;
using Eigen::ArrayXd;

namespace {

enum Goal { none, positive, negative, both };

ArrayXd cell(Index size, Index active) {
    ArrayXd out = ArrayXd::Zero(size);
    if (active >= 0) out[active] = 1;
    return out;
}

/// An open layer. A prototype is a patch (one active cell), an action is one active cell.
struct Layer {
    static constexpr Index patches = 6, actions = 3;
    ContextualLayer layer;
    Settings settings{0.5, 0.95, 1.1, 0.005, 0.1};

    Layer(Index height, Index width) : layer(height, width, patches, actions) {}
    /// One step. -1 stands for no patch, and for no action.
    void step(Index patch, Index action = -1, Goal goal = none, double discrepancy = 0.05) {
        layer.update({cell(actions, action), cell(patches, patch), goal == positive || goal == both ? 0.3 : 0,
                      goal == negative || goal == both ? 0.3 : 0, discrepancy},
                     settings);
    }
    const LongTermMemory& memory() const { return layer.memory(); }
    /// The patch of a segment: the nearest one.
    Index patch_of(Index row, Index column) {
        for (Index p = 0; p < patches; ++p) {
            auto copy = *this;
            copy.step(p);
            if (copy.memory().distance()(row, column) < 0.01F) return p;
        }
        return -1;
    }
};

}  // namespace

TEST_CASE(
    "The layer is closed until the discrepancy is once between 1e-6 and the threshold; then it is open for "
    "good") {
    Layer l(2, 4);
    for (const double d : {1.0, 0.0, 1e-6, static_cast<double>(0.1F), -0.05}) {
        l.step(1, 0, positive, d);
        CHECK_FALSE(l.layer.open());
    }
    CHECK(l.memory().length(0) == 0);
    CHECK(l.layer.recent().size() == 0);  // a closed layer stores nothing
    l.step(1, 0, none, 0.0999);
    CHECK(l.layer.open());
    l.step(2, 0, positive, 1);
    CHECK(l.layer.open());
    CHECK(l.memory().length(0) == 2);
}

TEST_CASE("A goal stores what happened before it as one sequence, newest first") {
    Layer l(4, 4);
    l.step(1, 0);
    l.step(2, 1);
    l.step(3, 2, positive);
    CHECK(l.layer.stored_row() == 0);
    REQUIRE(l.memory().length(0) == 3);
    CHECK(l.patch_of(0, 0) == 3);
    CHECK(l.patch_of(0, 1) == 2);
    CHECK(l.patch_of(0, 2) == 1);
    CHECK(l.memory().action(0, 2)[0] == 1);
    CHECK(l.layer.recent().size() == 0);
    l.step(-1);
    CHECK(l.layer.stored_row() == -1);
}

TEST_CASE("A couplet without a prototype is not stored; one without an action is") {
    Layer l(4, 4);
    l.step(-1, 2);
    CHECK(l.layer.recent().size() == 0);
    l.step(1, -1);
    CHECK(l.layer.recent().size() == 1);
}

TEST_CASE("A goal with an empty short-term memory has no effect") {
    Layer l(3, 3);
    l.step(-1, 0, positive);
    CHECK(l.memory().next_row() == 0);
    CHECK(l.memory().length(0) == 0);
}

TEST_CASE("A negative goal deletes the episode except for its own step; a positive goal has precedence") {
    Layer l(4, 4);
    l.step(1);
    l.step(2);
    l.step(3, 0, negative);
    CHECK(l.layer.recent().size() == 1);
    l.step(4, 0, both);
    REQUIRE(l.memory().length(0) == 2);
    CHECK(l.patch_of(0, 0) == 4);
    CHECK(l.patch_of(0, 1) == 3);
}

TEST_CASE("A goal that lasts stores a sequence in every step with a prototype") {
    Layer l(4, 4);
    for (int i = 0; i < 3; ++i) l.step(1, 0, positive);
    l.step(-1, 0, positive);
    CHECK(l.memory().next_row() == 3);
    for (Index row = 0; row < 3; ++row) CHECK(l.memory().length(row) == 1);
}

TEST_CASE("A full memory replaces its oldest sequence completely, whatever its length") {
    Layer l(3, 5);
    for (Index p = 0; p < 3; ++p) {
        l.step(0);
        l.step(1);
        l.step(p, 0, positive);
    }
    CHECK(l.memory().next_row() == 0);
    l.step(5, 0, positive);
    CHECK(l.memory().next_row() == 1);
    CHECK(l.memory().length(0) == 1);
    CHECK(l.patch_of(0, 0) == 5);
    for (Index column = 1; column < 5; ++column) {
        CHECK(l.memory().distance()(0, column) == 1);
        CHECK(l.memory().collector()(0, column) == 0);
        CHECK(l.memory().trigger()(0, column) == 0);
        CHECK(l.memory().selected()(0, column) == 0);
    }
    CHECK(l.memory().length(1) == 3);
}

TEST_CASE("A sequence has at most the newest segments up to the height of the memory") {
    Layer l(3, 6);
    for (Index p = 0; p < 5; ++p) l.step(p, 0, p == 4 ? positive : none);
    REQUIRE(l.memory().length(0) == 3);
    for (Index column = 0; column < 3; ++column) CHECK(l.patch_of(0, column) == 4 - column);
}

TEST_CASE("A memory that is higher than wide keeps as many segments as its width") {
    Layer l(6, 2);
    for (int sequence = 0; sequence < 10; ++sequence)
        for (Index p = 0; p < 5; ++p) l.step(p, 0, p == 4 ? positive : none);
    for (Index row = 0; row < 6; ++row) {
        REQUIRE(l.memory().length(row) == 2);
        CHECK(l.patch_of(row, 0) == 4);
        CHECK(l.patch_of(row, 1) == 3);
    }
}

TEST_CASE("A memory of one segment remembers the last couplet") {
    Layer l(1, 1);
    l.step(1);
    l.step(2, 1, positive);
    l.step(2);
    CHECK(l.layer.action()[1] == Approx(1));
}

TEST_CASE("The action is that of the selected segments, divided by their distance to the goal") {
    Layer l(4, 4);
    l.step(1, 0);
    l.step(2, 1);
    l.step(3, 2, positive);
    l.settings.trigger_reset = 1;
    for (Index p = 1; p <= 3; ++p) {
        l.step(p);
        for (Index a = 0; a < 3; ++a)
            CHECK(l.layer.action()[a] ==
                  Approx(a == p - 1 ? 1.0 / static_cast<double>(4 - p) : 0).margin(1e-6));
    }
    l.step(-1);
    CHECK((l.layer.action() == 0).all());
    l.settings.memory_threshold = 0.9;
    l.step(5);
    CHECK((l.layer.action() == 0).all());  // different from all stored prototypes
}

TEST_CASE("The trigger distinguishes equal prototypes by their predecessors") {
    Layer l(4, 6);
    for (int repeat = 0; repeat < 2; ++repeat)
        for (const Index route : {0, 1}) {
            l.step(route);  // patch 0 or 1, then 5, then the goal by turning to that side
            l.step(5, route, positive);
        }
    for (const Index route : {0, 1}) {
        auto copy = l;
        copy.step(route);
        copy.step(5);
        CHECK(copy.layer.action()[route] > 1);
        CHECK(copy.layer.action()[1 - route] == 0);
    }
    for (int i = 0; i < 2000; ++i) l.step(-1);
    l.step(5);  // the triggers have decayed: both
    CHECK(l.layer.action()[0] > 1);
    CHECK(l.layer.action()[0] == l.layer.action()[1]);
}

TEST_CASE("A raised trigger decays to 1, and is 1 after its segment is selected") {
    Layer l(2, 4);
    l.settings.trigger_decay = 0.5;
    l.step(1);
    l.step(2, 0, positive);
    l.step(1);
    CHECK(l.memory().trigger()(0, 0) == 1.1F);
    l.step(-1);
    CHECK(l.memory().trigger()(0, 0) == Approx(1.05));
    l.step(-1);
    CHECK(l.memory().trigger()(0, 0) == Approx(1.025));
    l.step(2);
    CHECK(l.memory().collector()(0, 0) == Approx(1.0125));
    CHECK(l.memory().trigger()(0, 0) == 1);
}

TEST_CASE("All of several equal candidates are selected, also if only the best may be") {
    Layer l(3, 3);
    l.settings.winner_share = 1;
    for (int i = 0; i < 3; ++i) l.step(2, 1, positive);
    l.step(2);
    CHECK(l.memory().selected().sum() == 3);
    CHECK(l.layer.action()[1] == Approx(3));
}

TEST_CASE("A candidate must be above the threshold, not at it") {
    Layer l(2, 2);
    l.step(2, 1, positive);
    l.settings.memory_threshold = 1;
    l.step(2);
    CHECK(l.memory().selected().sum() == 0);
    l.settings.memory_threshold = 0.99;
    l.step(2);
    CHECK(l.memory().selected().sum() == 1);
}
