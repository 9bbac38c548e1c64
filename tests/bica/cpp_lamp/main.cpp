// The robot of cpp_lamp: steps every 0.1 ms, 20 ms of its time, until standard input ends. It counts what its thread allocates.
#include <atomic>
#include <cstdlib>
#include <new>

#include "lamps/live.hpp"

namespace {
thread_local bool is_counting = false;
std::int64_t allocations = 0;
bica::Nanoseconds now_ns = 0;
}  // namespace

#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(std::size_t size) {
    if (is_counting) {
        ++allocations;
    }
    void* memory = std::malloc(size);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

class Eyes final : public lamps::Eyes {
public:
    using lamps::Eyes::Eyes;

private:
    void work() override { distance -= 0.0; }
};

int main(int count, char** words) {
    bica::Root root;
    Eyes eyes(root);
    lamps::Components components(root, eyes);
    int holds = 0;
    std::atomic<bool> is_over{false};
    bica::LiveOptions options(count, words);
    if (count == 1 || std::strcmp(words[count - 1], "--no-hold") != 0) {
        options.hold = [&holds] { ++holds; };
    }
    options.is_stopping = [&is_over] { return is_over.load(); };
    options.clock = [] { return now_ns; };
    bica::Live live(root, components.lamp, lamps::live_project(components), options);
    if (!live.problem().empty()) {
        return 2;
    }
    std::thread waiting([&is_over] {
        while (std::getchar() != EOF) {
        }
        is_over = true;
    });
    is_counting = true;
    while (!is_over) {
        root.step(components.lamp, now_ns);
        now_ns += 20'000'000;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    is_counting = false;
    waiting.join();
    std::printf("%lld iterations, %lld allocations, %d holds\n", static_cast<long long>(root.iteration()), static_cast<long long>(allocations), holds);
    return 0;
}
