#include "bug_interface/motion/motor.h"

#include <cmath>
#include <vector>

#include "tests/support/catch.h"

using forage::bug::decode_motor;
using forage::bug::in_words;
using forage::bug::motor_winner;
using forage::bug::MotorCommand;

namespace {

std::vector<double> cells_with(std::vector<std::pair<std::size_t, double>> active, std::size_t size = 81) {
    std::vector<double> cells(size, 0.0);
    for (const auto& [cell, value] : active) cells[cell] = value;
    return cells;
}

/// The command of a 9 x 9 group whose cell (column, row), counted from 1, is active.
MotorCommand command_of(int column, int row) {
    return decode_motor(cells_with({{static_cast<std::size_t>((row - 1) * 9 + column - 1), 0.3}}), 9, 9, 2.0,
                        1.5);
}

}  // namespace

TEST_CASE("Rows of the motor group stand for speeds, columns for turns, and left is positive") {
    for (int row = 1; row <= 9; ++row)
        for (int column = 1; column <= 9; ++column) {
            const MotorCommand c = command_of(column, row);
            CHECK(c.forward == (5 - row) * 0.25 * 2.0);
            CHECK(c.turn == (5 - column) * 0.25 * 1.5);
        }
    CHECK(command_of(5, 5) == MotorCommand{0, 0});
    CHECK_FALSE(std::signbit(command_of(5, 5).forward));
}

TEST_CASE("Commands have words, and a group without a winner has no command") {
    CHECK(in_words(command_of(5, 1)) == "straight ahead");
    CHECK(in_words(command_of(5, 9)) == "straight back");
    CHECK(in_words(command_of(4, 2)) == "ahead in a left turn");
    CHECK(in_words(command_of(9, 8)) == "back in a right turn");
    CHECK(in_words(command_of(1, 5)) == "turn left on the spot");
    CHECK(in_words(command_of(5, 5)) == "stand still");
    CHECK(motor_winner(cells_with({{4, 0.5}, {7, 0.6}})) == 7);
    CHECK_FALSE(motor_winner(cells_with({})));
    CHECK_FALSE(motor_winner(std::vector<double>(81, 1.0)));
}

TEST_CASE("The activity of the winner does not matter") {
    CHECK(decode_motor(cells_with({{4, 1e-3}}), 9, 9, 1, 1) == MotorCommand{1, 0});
    CHECK(decode_motor(cells_with({{4, 1e6}, {76, 9e5}}), 9, 9, 1, 1) == MotorCommand{1, 0});
}

TEST_CASE(
    "Of several equal winners, the first wins if single precision rounds up, the last if it rounds down") {
    for (const double value : {1.0, 0.5, 0.25, 0.1, 0.8}) {
        INFO(value);
        CHECK(decode_motor(cells_with({{0, value}, {1, value}}), 9, 9, 1, 1) == MotorCommand{1, 1});
    }
    for (const double value : {0.7, 0.9, 0.95}) {
        INFO(value);
        CHECK(decode_motor(cells_with({{0, value}, {1, value}}), 9, 9, 1, 1) == MotorCommand{1, 0.75});
    }
}

TEST_CASE("Without a winner the robot stands still") {
    CHECK(decode_motor({}, 9, 9, 1, 1) == MotorCommand{});
    CHECK(decode_motor(std::vector<double>(81, 0.0), 9, 9, 1, 1) == MotorCommand{});
    CHECK(decode_motor(std::vector<double>(81, 0.7), 9, 9, 1, 1) == MotorCommand{});
    CHECK(decode_motor(std::vector<double>(81, 0.1), 9, 9, 1, 1) == MotorCommand{});
    CHECK(decode_motor(std::vector<double>(81, std::nan("")), 9, 9, 1, 1) == MotorCommand{});
    auto negative = std::vector<double>(81, -1.0);
    negative[3] = -0.5;
    CHECK(decode_motor(negative, 9, 9, 1, 1) == MotorCommand{});
    CHECK(decode_motor(cells_with({{3, 1e-60}}), 9, 9, 1, 1) == MotorCommand{});  // 0 in single precision
    CHECK(decode_motor(std::vector<double>{0, 1, 0}, 3, 1, 1, 1) == MotorCommand{});
    CHECK(decode_motor(std::vector<double>{0, 1, 0}, 1, 3, 1, 1) == MotorCommand{});
}

TEST_CASE("The offsets of a group that is not square have width and height swapped") {
    for (int row = 0; row < 9; ++row)
        CHECK(decode_motor(cells_with({{static_cast<std::size_t>(row * 5), 1}}, 45), 5, 9, 1, 1).forward ==
              1 - 0.5 * row);
    for (int column = 0; column < 9; ++column)
        CHECK(decode_motor(cells_with({{static_cast<std::size_t>(column), 1}}, 45), 9, 5, 1, 1).turn ==
              1 - 0.5 * column);
}

TEST_CASE("A group of even size is asymmetric") {
    CHECK(decode_motor(cells_with({{0, 1}}, 64), 8, 8, 1, 1) == MotorCommand{1, 1});
    CHECK(decode_motor(cells_with({{63, 1}}, 64), 8, 8, 1, 1) == MotorCommand{-0.75, -0.75});
}
