// A run that obeys commands does not allocate memory while none arrives.
#include "core/model/build.h"
#include "core/run/remote_control.h"
#include "core/run/run.h"
#include "neurons/neurons.h"
#include "tests/support/catch.h"
#include "tests/support/count_allocations.h"

using namespace forage;

TEST_CASE("Looking for a command does not allocate memory") {
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 1, 1, "neuronLinearThreshold");
    Registry registry;
    add_neurons(registry);
    Diagnostics diagnostics;
    auto run = Run::make(system, registry, nullptr, {}, diagnostics);
    REQUIRE(run);
    auto& remote = run->add(std::make_unique<RemoteControl>(Endpoint{}));
    run->step();
    remote.execute_pending(*run);
    const std::size_t before = test::allocations();
    for (int i = 0; i < 100; ++i) remote.execute_pending(*run);
    CHECK(test::allocations() == before);
}
