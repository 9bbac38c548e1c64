/// Runs robots on inputs from a file; shared by all drivers of `vicode conform`.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <type_traits>
#include <vector>

#include "bica.hpp"

#if !defined(BICA_HOST) || defined(BICA_NO_NAMES)
#error "Traces need names and files: compare without BICA_NO_NAMES and BICA_NO_HOST."
#endif

namespace bica::conformance {

/// An output with arguments: its base value, and the weighted sum of its arguments.
template <class Value>
Value derive(double base, double total, std::int64_t elements) {
    if constexpr (std::is_same_v<Value, bica::Real>) {
        return base + total;
    } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        return bica::to_int(base + total);
    } else {
        const double size = std::fabs(total);
        const std::int64_t steps = size < 9007199254740992.0 ? bica::floor(size) : 0;
        if constexpr (std::is_same_v<Value, bool>) {
            return (base != 0.0) != (steps % 2 == 1);
        } else {
            return static_cast<Value>((static_cast<std::int64_t>(base) + steps) % elements);
        }
    }
}

/// A root with its components; each project derives a class from it.
struct Robot {
    virtual ~Robot() = default;
    virtual void set(unsigned input, double value) = 0;
    virtual void step(bica::Nanoseconds time_ns) = 0;
    virtual void provide_shared(bica::TraceWriter& writer) = 0;

    bica::Root root;
};

/// Reads lines: "s ROBOT INPUT VALUE" sets an input, "t TIME" runs an iteration of all robots.
inline void run(Robot* (*make)(), std::FILE* input, const std::vector<std::FILE*>& traces, std::int64_t team_ticks) {
    std::vector<std::unique_ptr<Robot>> robots;
    std::vector<std::unique_ptr<bica::TraceWriter>> writers;
    std::vector<bica::TeamMessage> sent;
    for (std::FILE* file : traces) {
        robots.emplace_back(make());
        writers.push_back(std::make_unique<bica::TraceWriter>(file));
        bica::Root& root = robots.back()->root;
        root.observer = writers.back().get();
        root.team.priority = static_cast<std::int64_t>(robots.size()) - 1;
        root.team.ticks = team_ticks;
        robots.back()->provide_shared(*writers.back());
        sent.push_back(root.team.tell());
    }
    char command = ' ';
    while (std::fscanf(input, " %c", &command) == 1) {
        if (command == 's') {
            unsigned robot = 0;
            unsigned number = 0;
            double value = 0.0;
            if (std::fscanf(input, "%u %u %lf", &robot, &number, &value) == 3) {
                robots.at(robot)->set(number, value);
            }
            continue;
        }
        long long time_ns = 0;
        if (std::fscanf(input, "%lld", &time_ns) != 1) {
            return;
        }
        const std::vector<bica::TeamMessage> received = sent;
        for (std::size_t index = 0; index < robots.size(); ++index) {
            Robot& robot = *robots[index];
            if (robots.size() > 1) {
                robot.root.team.prepare();
            }
            for (std::size_t sender = 0; sender < received.size(); ++sender) {
                if (sender != index) {
                    robot.root.team.hear(received[sender]);
                }
            }
            robot.step(time_ns);
            writers[index]->end_iteration(robot.root);
            sent[index] = robot.root.team.tell();
        }
    }
}

}  // namespace bica::conformance
