// Two robots in two threads, which a third one stops.
#include <array>
#include <atomic>
#include <cstdio>
#include <thread>

#include "rescue/components.hpp"

class Robot final : public rescue::World {
public:
    double amount_turned() override { return turned; }
    double laser_max() override { return 4.0; }
    double laser_min_wnw() override { return 1.0; }
    double laser_min_nw() override { return 1.0; }
    double laser_min_nnw() override { return 1.0; }
    double laser_min_n() override { return 4.0; }
    double laser_min_nne() override { return 1.0; }
    double laser_min_ne() override { return 1.0; }
    double laser_min_ene() override { return 1.0; }
    void differential_drive(double, double turning_speed) override { turned += turning_speed * 0.02; }
    void wait(double) override {}

    double turned = 0.0;
};

struct Program {
    void run(const std::atomic<bool>& is_stopping) {
        root.observer = &statistics;
        bica::run(root, components.drive_circle, 1'000'000, [&] {
            iterations = root.iteration();
            return is_stopping.load();
        });
    }

    bica::Root root;
    Robot robot;
    rescue::Components components{root, robot};
    bica::CycleStatistics<> statistics;
    std::atomic<std::int64_t> iterations{0};
};

int main() {
    std::array<Program, 2> programs;
    std::atomic<bool> is_stopping{false};
    std::thread first([&] { programs[0].run(is_stopping); });
    std::thread second([&] { programs[1].run(is_stopping); });
    while (programs[0].iterations < 20 || programs[1].iterations < 20) {
        std::this_thread::yield();
    }
    is_stopping = true;
    first.join();
    second.join();
    for (const Program& program : programs) {
        for (const bica::CycleTimes& times : program.statistics) {
            std::printf("%s %d\n", times.component->name(), times.count >= 20);
        }
    }
    return 0;
}
