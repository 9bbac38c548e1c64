// Runs designs/forward against the field that a Python process simulates: hand-written components ask it over a pipe.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>

#include "forward/components.hpp"

namespace {

long allocations = 0;

/// The process that runs the field; floats are hexadecimal, so that none is rounded.
class Field {
public:
    void send(const char* words) { std::fprintf(stdout, "%s", words); }
    void send(double value) { std::fprintf(stdout, " %a", value); }
    void end() {
        std::fputc('\n', stdout);
        std::fflush(stdout);
    }
    double read() {
        std::array<char, 64> word{};
        if (std::scanf("%63s", word.data()) != 1) {
            std::exit(2);
        }
        return std::strtod(word.data(), nullptr);
    }

    bool read_bool() { return read() != 0.0; }
    void ask(const char* words) {
        send(words);
        end();
    }
};

class Perception final : public forward::Perception {
public:
    Perception(bica::Root& robot, Field& field) : forward::Perception(robot), field_(field) {}

    double bearing_to(double x, double y) override {
        field_.send("bearing_to Perception");
        field_.send(x);
        field_.send(y);
        field_.end();
        return field_.read();
    }

private:
    void work() override {
        field_.ask("work Perception");
        ball_seen = field_.read_bool();
        for (double* value : {&ball_x, &ball_y, &ball_distance, &ball_bearing, &ball_ahead, &ball_left, &ball_age}) {
            *value = field_.read();
        }
        net_seen = field_.read_bool();
        for (double* value : {&net_bearing, &net_distance, &net_age}) {
            *value = field_.read();
        }
        bottom_camera = field_.read_bool();
        neck_pan = field_.read();
        neck_tilt = field_.read();
        fallen = field_.read_bool();
    }

    Field& field_;
};

class Head final : public forward::Head {
public:
    Head(bica::Root& robot, Field& field) : forward::Head(robot), field_(field) {}

private:
    void work() override {
        field_.send("work Head");
        field_.send(parameters.pan);
        field_.send(parameters.tilt);
        field_.end();
        pan = field_.read();
        tilt = field_.read();
    }

    Field& field_;
};

class Walk final : public forward::Walk {
public:
    Walk(bica::Root& robot, Field& field) : forward::Walk(robot), field_(field) {}

private:
    void work() override {
        field_.send("work Walk");
        field_.send(parameters.forward);
        field_.send(parameters.lateral);
        field_.send(parameters.turn);
        field_.end();
    }

    Field& field_;
};

class Kicker final : public forward::Kicker {
public:
    Kicker(bica::Root& robot, Field& field) : forward::Kicker(robot), field_(field) {}

private:
    void restart() override {
        field_.ask("restart Kicker");
        busy = field_.read_bool();
    }
    void work() override {
        field_.send("work Kicker ");
        field_.send(name_of(parameters.kick));
        field_.send(" ");
        field_.send(name_of(parameters.side));
        field_.end();
        busy = field_.read_bool();
    }

    Field& field_;
};

class StandUp final : public forward::StandUp {
public:
    StandUp(bica::Root& robot, Field& field) : forward::StandUp(robot), field_(field) {}

private:
    void work() override { field_.ask("work StandUp"); }

    Field& field_;
};

}  // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) {
        return memory;
    }
    std::abort();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

/// Arguments: the number of ticks of 20 ms, and the file of the trace ("-": none).
int main(int count, char** words) {
    if (count < 3) {
        return 2;
    }
    bica::Root root;
    Field field;
    Perception perception(root, field);
    Head head(root, field);
    Walk walk(root, field);
    Kicker kicker(root, field);
    StandUp stand_up(root, field);
    forward::Components components(root, perception, head, walk, kicker, stand_up);
    std::FILE* file = std::strcmp(words[2], "-") != 0 ? std::fopen(words[2], "w") : nullptr;
    std::array<char, 4096> buffer{};
    std::optional<bica::TraceWriter> trace;
    if (file != nullptr) {
        root.observer = &trace.emplace(file);
    }
    field.ask("advance 0");
    static_cast<void>(field.read());
    allocations = 0;
    for (long tick = 0; tick < std::atol(words[1]); ++tick) {
        const bica::Nanoseconds now = tick * 20'000'000;
        std::snprintf(buffer.data(), buffer.size(), "advance %lld", static_cast<long long>(now));
        field.ask(buffer.data());
        if (!field.read_bool()) {
            break;
        }
        root.step(components.player, now);
        if (trace) {
            trace->end_iteration(root);
        }
    }
    std::fprintf(stderr, "%ld", file != nullptr ? 0L : allocations);
    if (file != nullptr) {
        std::fclose(file);
    }
    return 0;
}
