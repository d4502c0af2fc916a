// Systems with their files and types, as other programs use them.
#include <filesystem>
#include <utility>

#include <forage/forage.h>
#include <forage/system.h>

#include "core/base/output_files.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;

namespace {

SystemFile echo() {
    SystemFile file = new_system("echo");
    const auto p = model::add_process(file.model, "Brain");
    const auto a = model::add_group(file.model, p, "Ear", 3, 1, "neuronRandomSpike");
    const auto b = model::add_group(file.model, p, "Mouth", 3, 1, "neuronLinearThreshold");
    const auto c = model::add_connection(file.model, a, b, InputKind::excitatory, "synapseFixedWeight");
    model::set_parameter(*model::find_connection(file.model, c)->synapse, "weight", "0.5");
    model::find_connection(file.model, c)->delay = {model::UniformFunction{2}, {}};
    return file;
}

}  // namespace

TEST_CASE("A system that was built runs like its file, and a saved run of it continues without a file") {
    SystemFile file = echo();
    CHECK(file.path == "echo.iqr");
    Run built = open(file, {.seed = 3});
    built.until({.cycles = 20});
    const auto place = test::temporary_path("forage_system_file_test");
    make_directory(place.string());
    save(file, (place / "echo.iqr").string());
    Run read = open((place / "echo.iqr").string(), {.seed = 3});
    read.until({.cycles = 20});
    CHECK(built.digest() == read.digest());
    Run resumed = resume(save_state(built));
    resumed.until({.cycles = 5}), read.until({.cycles = 5});
    CHECK(resumed.digest() == read.digest());
    CHECK(read_system(file.path).model == file.model);
    std::filesystem::remove_all(place);
}

TEST_CASE("The mistakes of a system that was built have places in its text") {
    SystemFile file = echo();
    file.model.connections[0].synapse->type = "synapseFixed";
    Diagnostics diagnostics;
    CHECK_FALSE(compile(file, {}, 1, diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].where.file->path == "echo.iqr");
    CHECK(diagnostics.all()[0].where.line > 1);
    CHECK_THROWS_AS(open(file), InputError);
}

TEST_CASE("Warnings are added to those of earlier calls") {
    Diagnostics warnings;
    warnings.warning({}, "earlier");
    SystemFile file = echo();
    edit(file, "[]", &warnings);
    const auto place = test::temporary_path("forage_system_warnings_test");
    make_directory(place.string());
    save(file, (place / "echo.iqr").string());
    edit_file(file.path, "[]", {}, {}, &warnings);
    read_system(file.path, {}, false, &warnings);
    parse_system(text_of(file), file.path, {}, &warnings);
    Run run = open(file, {}, &warnings);
    run.set("Brain/Ear.probability=2", &warnings);
    draw(run, "diagram", "svg", 0, &warnings);
    REQUIRE(warnings.warnings() == 2);
    CHECK(warnings.all()[0].message == "earlier");
    CHECK(warnings.all()[1].message == "set 'Brain/Ear.probability=2': outside the usual range 0 to 1");
    std::filesystem::remove_all(place);
}

TEST_CASE("A synapse's strength is what it delivers") {
    const SystemFile file = echo();
    const auto table = synapses(file, file.model.connections[0].id, 1);
    CHECK(table.source == std::vector{0, 1, 2});
    CHECK(table.target == std::vector{0, 1, 2});
    CHECK(table.delay == std::vector{2, 2, 2});
    CHECK(table.strength == std::vector{0.5, 0.5, 0.5});
    CHECK_THROWS_AS(synapses(file, "nothing", 1), InputError);
}

TEST_CASE("Weights in a file beside the system are those of its synapses, also when it was built") {
    const auto place = test::temporary_path("forage_system_weights_test");
    make_directory(place.string());
    write_file((place / "w.csv").string(), "1,0,0\n0,2,0\n0,0,3\n");
    SystemFile file = echo();
    file.path = (place / "echo.iqr").string();
    model::Weights weights;
    weights.file = "w.csv";
    file.model.connections[0].pattern = weights;
    file.model.connections[0].arborization = {};
    write_file(file.path, text_of(file));
    const SystemFile read = read_system(file.path);
    for (const SystemFile* f : {&std::as_const(file), &read}) {
        const auto strength = synapses(*f, f->model.connections[0].id, 1).strength;
        CHECK(strength == std::vector{0.5, 0., 0., 0., 1., 0., 0., 0., 1.5});
    }
    std::filesystem::remove_all(place);
}

TEST_CASE("A diagram has the comments, phantoms and vertices of its page, and of no other page") {
    SystemFile file = echo();
    auto& s = file.model;
    const auto q = model::add_process(s, "Body");
    const auto far = model::add_group(s, q, "Arm", 1, 1, "neuronLinearThreshold");
    const auto c =
        model::add_connection(s, s.connections[0].target, far, InputKind::excitatory, "synapseFixedWeight");
    model::complete(s.processes, s.connections);
    const auto pages = [&] {
        return std::vector{diagram(file, {}, "svg"), diagram(file, "Brain", "svg"),
                           diagram(file, "Body", "svg")};
    };
    const auto differ = [&, before = pages()](bool brain, bool body) {
        const auto now = pages();
        return now[0] != before[0] && (now[1] != before[1]) == brain && (now[2] != before[2]) == body;
    };
    const SystemFile plain = file;
    model::add_canvas_comment(s, s.processes[0].id, {"", "Why it\necho", "#204060", {0, 200, 90, 30}, {}});
    CHECK(differ(true, false));
    file = plain;
    s.processes[1].phantoms = {{s.connections[0].target, 300, 40}};
    CHECK(differ(false, true));
    file = plain;
    model::find_connection(s, c)->line->source_vertices = {{-40, -40, {}}};
    CHECK(differ(true, false));
    file = plain;
    model::find_connection(s, c)->line->vertices = {{-40, -40, {}}};
    CHECK(differ(false, false));
    file = plain;
    model::add_canvas_comment(s, {}, {"", "All", "", {0, 200, 90, 30}, {}});
    CHECK(differ(false, false));
}

TEST_CASE("A diagram has the formats of pictures") {
    CHECK(diagram(echo(), "Brain", "svg").find("<svg") != std::string::npos);
    CHECK_THROWS_AS(diagram(echo(), {}, "bmp"), InputError);
    CHECK_THROWS_AS(diagram(echo(), "Brian"), InputError);
}
