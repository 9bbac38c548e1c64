/// The live view and the recorder of robots in C++ (docs/live.md and docs/traces.md in vicode). It needs the standard
/// library, threads and sockets. The thread that steps the root allocates, sends and writes nothing: it copies the newest
/// iteration into memory that was reserved before; other threads format and send it.
#pragma once

#include "bica.hpp"

#if !defined(BICA_HOST) || defined(BICA_NO_NAMES)
#error "The live view needs a host and names: compile without BICA_NO_HOST and BICA_NO_NAMES."
#endif

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <locale>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#if defined(_WIN32)
#if !defined(NOMINMAX)
#define NOMINMAX
#endif
#include <winsock2.h>
#include <ws2tcpip.h>
#include <io.h>
#else
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#endif

namespace bica {
BICA_OPEN

// Values and components

/// A value of a component at one time.
struct LiveValue {
    enum class Kind : std::uint8_t { boolean, integer, number, element };

    const char* name = "";
    Kind kind = Kind::boolean;
    std::int64_t integer = 0;
    double number = 0.0;
    const char* type = "";
    const char* element = "";
};

/// A value that viewers may set, where it is stored.
struct LiveField {
    const char* name;
    LiveValue::Kind kind;
    void* place;
    void (*write)(void* place, const LiveValue& value);
    const char* type = "";
    std::vector<const char*> elements{};
};

class LiveFields {
public:
    void add(const char* name, bool& value) {
        all.push_back({name, LiveValue::Kind::boolean, &value, [](void* place, const LiveValue& given) { *static_cast<bool*>(place) = given.integer != 0; }});
    }
    void add(const char* name, std::int64_t& value) {
        all.push_back({name, LiveValue::Kind::integer, &value, [](void* place, const LiveValue& given) { *static_cast<std::int64_t*>(place) = given.integer; }});
    }
    void add(const char* name, Real& value) {
        all.push_back({name, LiveValue::Kind::number, &value, [](void* place, const LiveValue& given) { *static_cast<Real*>(place) = given.number; }});
    }
    template <class Enum>
    void add(const char* name, const char* type, Enum& value, int count) {
        LiveField field{name, LiveValue::Kind::element, &value, [](void* place, const LiveValue& given) { *static_cast<Enum*>(place) = static_cast<Enum>(given.integer); }, type};
        for (int index = 0; index < count; ++index) {
            field.elements.push_back(name_of(static_cast<Enum>(index)));
        }
        all.push_back(std::move(field));
    }

    std::vector<LiveField> all;
};

/// What viewers see of a component, and what they may change.
struct LiveComponent {
    Component* component;
    const char* design;
    const char* code;
    double frequency_hz;
    LiveFields fields{};
    std::vector<const char*> states{};
    void (*enter)(Component&, std::size_t state) = nullptr;
    bool (*action_done)(const Component&) = nullptr;
    bool (*conflict)(const Component&) = nullptr;
    /// The error that replaces the next step; empty if there is none.
    std::array<char, 201> injected{};

    template <class Machine>
    void set_states(const Machine&, std::initializer_list<const char*> names) {
        states = names;
        enter = [](Component& target, std::size_t state) {
            Component::enter_state(static_cast<Machine&>(target), static_cast<typename Machine::State>(state));
        };
    }
    template <class Machine>
    void show_action_done(const Machine&) {
        action_done = [](const Component& target) { return Component::action_done_of(static_cast<const Machine&>(target)); };
    }
    template <class Machine>
    void show_conflict(const Machine&) {
        conflict = [](const Component& target) { return Component::conflict_of(static_cast<const Machine&>(target)); };
    }
};

/// The components of a robot; `live_project` in the generated `live.hpp` makes it.
struct LiveProject {
    std::deque<LiveComponent> components{};
    std::vector<const Component*> inputs{};
    std::vector<std::pair<const char*, const char*>> shared{};
    LiveFields constants{};

    LiveComponent& add(Component& component, const char* design, const char* code, double frequency_hz) {
        components.push_back({&component, design, code, frequency_hz});
        return components.back();
    }
    void add_input(const Component& component) { inputs.push_back(&component); }
};

/// What `Live` does; without values of its own it does nothing. See docs/live.md.
struct LiveOptions {
    LiveOptions() : LiveOptions(0, nullptr) {}

    /// Reads the environment (VICODE_WATCH, VICODE_RECORD …), and `--watch ADDRESS`, `--control`, `--without-hold` and
    /// `--record FILE`; other arguments are left to the program.
    LiveOptions(int count, const char* const* arguments) {
        const std::string allowed = environment("VICODE_WATCH_CONTROL");
        watch = environment("VICODE_WATCH");
        token = environment("VICODE_WATCH_TOKEN");
        name = environment("VICODE_ROBOT");
        record = environment("VICODE_RECORD");
        control = !allowed.empty() && allowed != "0";
        without_hold = allowed == "without-hold";
        const double asked = std::atof(environment("VICODE_RECORD_MINUTES").c_str());
        minutes = asked > 0.0 ? asked : minutes;
        for (int index = 1; index < count; ++index) {
            const std::string word = arguments[index];
            control = control || word == "--control";
            without_hold = without_hold || word == "--without-hold";
            if ((word == "--watch" || word == "--record") && index + 1 < count) {
                (word == "--watch" ? watch : record) = arguments[++index];
            }
        }
    }

    /// PORT, HOST:PORT or unix:PATH; empty: nobody can connect.
    std::string watch;
    std::string token;
    std::string name;
    bool control = false;
    bool without_hold = false;
    /// Stops the robot; called in the thread of the root.
    std::function<void()> hold;
    /// Ends a pause, such as the one that `run` gets.
    std::function<bool()> is_stopping;
    /// The clock whose times `step` of the root gets; pauses are left out of it.
    Nanoseconds (*clock)() = clock_ns;
    std::string record;
    double minutes = 5.0;

private:
    static std::string environment(const char* variable) {
        const char* text = std::getenv(variable);
        return text != nullptr ? text : "";
    }
};

namespace live {

using Clock = std::chrono::steady_clock;
using Text = decltype(LiveComponent::injected);

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

inline void copy_text(Text& target, const char* text) { std::snprintf(target.data(), target.size(), "%s", text); }

/// A queue of limited size without locks, which one thread fills and another empties.
template <class Item>
class Queue {
public:
    explicit Queue(std::vector<Item> items) : items_(std::move(items)) {}
    bool add(const Item& item) {
        const std::size_t head = head_.load(std::memory_order_relaxed);
        if (head - tail_.load(std::memory_order_acquire) == items_.size()) {
            return false;
        }
        items_[head % items_.size()] = item;
        head_.store(head + 1, std::memory_order_release);
        return true;
    }
    bool take(Item& item) {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);
        if (tail == head_.load(std::memory_order_acquire)) {
            return false;
        }
        item = items_[tail % items_.size()];
        tail_.store(tail + 1, std::memory_order_release);
        return true;
    }

private:
    std::vector<Item> items_;
    std::atomic<std::size_t> head_{0};
    std::atomic<std::size_t> tail_{0};
};

// Iterations

struct Span {
    const Component* component = nullptr;
    std::size_t begin = 0;
    std::size_t end = 0;
};

struct Step {
    Span values;
    Span parameters;
    const Component* by = nullptr;
    bool is_modulated = false;
    bool worked = false;
    bool done = false;
    signed char action_done = -1;
    signed char conflict = -1;
    const char* state = "";
    const char* changed_from = nullptr;
    const char* transition = nullptr;
    Nanoseconds state_time_ns = 0;
    Nanoseconds component_time_ns = 0;
    Nanoseconds step_ns = 0;
};

struct Error {
    const Component* component = nullptr;
    const char* state = "";
    Text message{};
};

struct Change {
    std::int64_t number = 0;
    std::int64_t iteration = 0;
    Nanoseconds time_ns = 0;
    const char* component = "";
    const char* source = "";
    const char* target = "";
    const char* transition = nullptr;
};

struct Head {
    std::int64_t iteration = 0;
    std::int64_t number = 0;
    Nanoseconds time_ns = 0;
    std::int64_t team_size = 1;
    std::int64_t errors_total = 0;
    std::int64_t dropped = 0;
    bool is_paused = false;
};

/// One iteration in reserved memory; what exceeds it is left out.
class Iteration final : public ValueVisitor {
public:
    static constexpr std::size_t most_errors = 20;

    void reserve(std::size_t most_steps, std::size_t most_values, std::size_t components) {
        steps.reserve(most_steps);
        values.reserve(most_values);
        errors.reserve(most_errors);
        inputs.reserve(components);
        still_done.reserve(components);
    }
    std::size_t bytes() const { return sizeof(*this) + steps.capacity() * sizeof(Step) + values.capacity() * sizeof(LiveValue) + errors.capacity() * sizeof(Error); }
    void clear() {
        steps.clear();
        values.clear();
        errors.clear();
        inputs.clear();
        still_done.clear();
    }
    void visit(const char* name, bool value) override { add({name, LiveValue::Kind::boolean, value ? 1 : 0}); }
    void visit(const char* name, std::int64_t value) override { add({name, LiveValue::Kind::integer, value}); }
    void visit(const char* name, double value) override { add({name, LiveValue::Kind::number, 0, value}); }
    void visit(const char* name, const char* type, const char* element) override { add({name, LiveValue::Kind::element, 0, 0.0, type, element}); }

    Head head;
    std::vector<Step> steps;
    std::vector<LiveValue> values;
    std::vector<Error> errors;
    std::vector<Span> inputs;
    std::vector<const Component*> still_done;

private:
    void add(const LiveValue& value) {
        if (values.size() < values.capacity()) {
            values.push_back(value);
        }
    }
};

// JSON

using bica::json_text;
inline std::string json_text(const std::string& text) { return json_text(text.c_str()); }

/// The shortest text of a number that reads as the same number, whatever the locale of the program is.
inline std::string number_text(double value) {
    if (!std::isfinite(value)) {
        return std::isnan(value) ? "\"nan\"" : value > 0 ? "\"inf\"" : "\"-inf\"";
    }
    std::array<char, 40> digits{};
    for (int precision = 15; precision <= 17; ++precision) {
        std::snprintf(digits.data(), digits.size(), "%.*g", precision, value);
        if (std::strtod(digits.data(), nullptr) == value) {
            break;
        }
    }
    std::string text = digits.data();
    std::replace(text.begin(), text.end(), ',', '.');
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

inline std::string value_text(const LiveValue& value) {
    switch (value.kind) {
        case LiveValue::Kind::boolean:
            return value.integer != 0 ? "true" : "false";
        case LiveValue::Kind::integer:
            return std::to_string(value.integer);
        case LiveValue::Kind::number:
            return number_text(value.number);
        case LiveValue::Kind::element:
            break;
    }
    return json_text(std::string(value.type) + "." + value.element);
}

inline std::string or_null(const char* text) { return text != nullptr ? json_text(text) : "null"; }

/// Writes one iteration as docs/traces.md describes it; without the closing bracket.
class Writer {
public:
    explicit Writer(const Iteration& iteration, bool has_values, bool has_durations) : iteration_(iteration), has_values_(has_values), has_durations_(has_durations) {}

    std::string write() {
        const Head& head = iteration_.head;
        text_ = "{\"iteration\":" + std::to_string(head.iteration) + ",\"time_ns\":" + std::to_string(head.time_ns) + ",\"tree\":[";
        for (const Step& step : iteration_.steps) {
            separate();
            write_step(step);
        }
        text_ += "],\"errors\":[";
        for (const Error& error : iteration_.errors) {
            separate();
            text_ += "{\"component\":" + json_text(error.component->name()) + ",\"state\":" + json_text(error.state) + ",\"message\":" + json_text(error.message.data()) + "}";
        }
        text_ += "],\"still_done\":[";
        for (const Component* component : iteration_.still_done) {
            separate();
            text_ += json_text(component->name());
        }
        text_ += "]";
        if (has_values_ && !iteration_.inputs.empty()) {
            text_ += ",\"inputs\":{";
            for (const Span& span : iteration_.inputs) {
                separate();
                text_ += json_text(span.component->name()) + ":";
                write_values(span);
            }
            text_ += "}";
        }
        return std::move(text_);
    }

private:
    void separate() {
        if (text_.back() != '[' && text_.back() != '{') {
            text_ += ",";
        }
    }
    void write_step(const Step& step) {
        const char* link = step.is_modulated ? "modulates" : "requires";
        text_ += "{\"component\":" + json_text(step.values.component->name()) + ",\"by\":" + or_null(step.by != nullptr ? step.by->name() : nullptr);
        text_ += ",\"link\":" + json_text(step.by == nullptr ? "root" : link) + ",\"worked\":" + (step.worked ? "true" : "false");
        text_ += ",\"state\":" + json_text(step.state) + ",\"state_time_ns\":" + std::to_string(step.state_time_ns);
        text_ += ",\"changed_from\":" + or_null(step.changed_from) + ",\"transition\":" + or_null(step.transition) + ",\"parameters\":";
        write_values(step.parameters);
        text_ += std::string(",\"done\":") + (step.done ? "true" : "false");
        if (step.action_done >= 0) {
            text_ += std::string(",\"action_done\":") + (step.action_done != 0 ? "true" : "false");
        }
        if (step.conflict >= 0) {
            text_ += std::string(",\"conflict\":") + (step.conflict != 0 ? "true" : "false");
        }
        if (iteration_.head.team_size != 1) {
            text_ += ",\"team_size\":" + std::to_string(iteration_.head.team_size);
        }
        if (has_values_) {
            text_ += ",\"component_time_ns\":" + std::to_string(step.component_time_ns) + ",\"values\":";
            write_values(step.values);
        }
        text_ += has_durations_ ? ",\"step_ns\":" + std::to_string(step.step_ns) + "}" : "}";
    }
    void write_values(const Span& span) {
        text_ += "{";
        for (std::size_t index = span.begin; index < span.end; ++index) {
            separate();
            text_ += json_text(iteration_.values[index].name) + ":" + value_text(iteration_.values[index]);
        }
        text_ += "}";
    }

    const Iteration& iteration_;
    bool has_values_;
    bool has_durations_;
    std::string text_;
};

/// A parsed JSON value; `raw` is its text.
struct Json {
    enum class Kind { null, boolean, integer, number, text, list, object };

    Kind kind = Kind::null;
    bool boolean = false;
    double number = 0.0;
    std::string text{};
    std::vector<Json> items{};
    std::map<std::string, Json> members{};
    std::string raw{};

    const Json& operator[](const char* name) const {
        static const Json none;
        const auto found = members.find(name);
        return found != members.end() ? found->second : none;
    }
    bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
    /// As Python's `str` and the words of error messages.
    std::string words() const { return kind == Kind::text ? text : kind == Kind::null ? "None" : raw; }
};

/// Reads a line; `parse` returns false if it is not JSON. The caller limits the depth.
class JsonReader {
public:
    explicit JsonReader(const std::string& line) : line_(line) {}

    bool parse(Json& value) { return read(value) && at_ == line_.size(); }

private:
    char peek() const { return at_ < line_.size() ? line_[at_] : '\0'; }
    void skip() { at_ = std::min(line_.find_first_not_of(" \t\r\n", at_), line_.size()); }
    bool accept(const char* word) {
        const bool is_next = line_.compare(at_, std::strlen(word), word) == 0;
        at_ += is_next ? std::strlen(word) : 0;
        return is_next;
    }
    bool read(Json& value) {
        skip();
        const std::size_t begin = at_;
        const char first = peek();
        value.kind = first == '{' ? Json::Kind::object : first == '[' ? Json::Kind::list : first == '"' ? Json::Kind::text : Json::Kind::null;
        const bool is_valid = first == '{' || first == '[' ? read_items(value) : first == '"' ? read_text(value.text) : read_word(value);
        value.raw = line_.substr(begin, at_ - begin);
        skip();
        return is_valid;
    }
    bool read_items(Json& value) {
        const bool has_names = value.kind == Json::Kind::object;
        const char end = has_names ? '}' : ']';
        ++at_;
        skip();
        for (bool is_first = true; peek() != end; is_first = false) {
            Json name;
            Json item;
            if ((!is_first && !accept(",")) || (has_names && (!read(name) || name.kind != Json::Kind::text || !accept(":"))) || !read(item)) {
                return false;
            }
            (has_names ? value.members[name.text] : value.items.emplace_back()) = std::move(item);
        }
        ++at_;
        return true;
    }
    bool read_word(Json& value) {
        if (accept("true") || accept("false")) {
            value.kind = Json::Kind::boolean;
            value.boolean = line_[at_ - 2] == 'u';
            return true;
        }
        if (accept("null")) {
            return true;
        }
        value.kind = Json::Kind::number;
        if (accept("NaN") || accept("Infinity") || accept("-Infinity")) {
            value.number = line_[at_ - 1] == 'N' ? nan : line_[at_ - 9] == '-' ? -infinity : infinity;
            return true;
        }
        const std::size_t begin = at_;
        at_ = std::min(line_.find_first_not_of("+-.0123456789eE", at_), line_.size());
        const std::string digits = line_.substr(begin, at_ - begin);
        std::istringstream stream(digits);
        stream.imbue(std::locale::classic());
        stream >> value.number;
        if (std::abs(value.number) == std::numeric_limits<double>::max()) {
            value.number = std::copysign(infinity, value.number);  // the stream limits numbers that are too large
        } else if (stream.fail()) {
            return false;
        }
        value.kind = digits.find_first_of(".eE") == std::string::npos ? Json::Kind::integer : Json::Kind::number;
        return true;
    }
    bool read_text(std::string& text) {
        for (++at_; peek() != '"'; ++at_) {
            if (at_ >= line_.size() || static_cast<unsigned char>(peek()) < 0x20) {
                return false;
            }
            if (peek() != '\\') {
                text += peek();
                continue;
            }
            ++at_;
            static const std::string escapes = "\"\\/bfnrt";
            const std::size_t index = escapes.find(peek());
            if (index != std::string::npos) {
                text += "\"\\/\b\f\n\r\t"[index];
            } else if (peek() != 'u' || !read_code(text)) {
                return false;
            }
        }
        ++at_;
        return true;
    }
    /// A code of four digits as UTF-8. Names of designs are ASCII, so halves of a pair are not joined.
    bool read_code(std::string& text) {
        const std::string digits = line_.substr(at_ + 1, 4);
        if (digits.size() != 4 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
            return false;
        }
        const auto code = static_cast<unsigned>(std::strtoul(digits.c_str(), nullptr, 16));
        at_ += 4;
        if (code >= 0x800) {
            text += static_cast<char>(0xe0U | (code >> 12U));
            text += static_cast<char>(0x80U | ((code >> 6U) & 0x3fU));
        } else if (code >= 0x80) {
            text += static_cast<char>(0xc0U | (code >> 6U));
        }
        text += static_cast<char>(code < 0x80 ? code : 0x80U | (code & 0x3fU));
        return true;
    }

    const std::string& line_;
    std::size_t at_ = 0;
};

inline void print_line(const char* kind, std::string text) {
    std::replace_if(text.begin(), text.end(), [](char each) { return static_cast<unsigned char>(each) < 0x20 || each == 0x7f; }, '?');
    std::fprintf(stderr, "%s: %s\n", kind, text.c_str());
}

// The recorder

/// Keeps the last minutes in files FILE.RUN.SEGMENT.jsonl; a thread writes them.
class Recorder {
public:
    Recorder(const std::string& path, double minutes, std::vector<Iteration> waiting)
        : path_(std::filesystem::absolute(path)), segment_ns_(nanoseconds(minutes * 6e9)), waiting_(std::move(waiting)) {
        find_run();
        has_failed_ = !open_segment();
        if (!has_failed_) {
            thread_ = std::thread([this] {
                while (!is_closing_.load(std::memory_order_acquire)) {
                    write_waiting();
                    std::this_thread::sleep_for(std::chrono::milliseconds(50));
                }
                write_waiting();
            });
        }
    }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;
    ~Recorder() {
        is_closing_.store(true, std::memory_order_release);
        if (thread_.joinable()) {
            thread_.join();
        }
        if (stream_ != nullptr) {
            std::fclose(stream_);
        }
    }

    /// Queues an iteration, or counts it as dropped; called by the thread of the root.
    void add(Iteration& iteration) {
        iteration.head.dropped = dropped_;
        dropped_ = waiting_.add(iteration) ? 0 : dropped_ + 1;
    }

private:
    static constexpr std::size_t segments_ = 10;
    static constexpr std::size_t kept_runs_ = 4;
    static constexpr std::size_t most_bytes_ = 512'000'000;

    void write_waiting() {
        Iteration iteration;
        while (waiting_.take(iteration)) {
            if (!has_failed_ && !write(iteration)) {
                has_failed_ = true;
                print_line("error", "cannot write the record " + path_.string() + "; the run continues without it");
            }
        }
        if (!has_failed_ && std::fflush(stream_) == 0 && now_s() - synced_s_ >= 1.0) {
            sync();
        }
    }
    bool write(const Iteration& iteration) {
        const bool is_old = iteration.head.time_ns - begin_ns_ >= segment_ns_;
        if (bytes_ != 0 && (is_old || bytes_ >= most_bytes_ / segments_)) {
            sync();
            std::fclose(stream_);
            if (!open_segment()) {
                return false;
            }
        }
        begin_ns_ = bytes_ == 0 ? iteration.head.time_ns : begin_ns_;
        std::string line = Writer(iteration, true, false).write();
        line += iteration.head.dropped != 0 ? ",\"dropped\":" + std::to_string(iteration.head.dropped) + "}\n" : "}\n";
        bytes_ += line.size();
        return std::fwrite(line.data(), 1, line.size(), stream_) == line.size();
    }
    /// Protects what was written from a loss of power.
    void sync() {
        std::fflush(stream_);
#if defined(_WIN32)
        _commit(_fileno(stream_));
#else
        fsync(fileno(stream_));
#endif
        synced_s_ = now_s();
    }
    std::filesystem::path file(int run, int segment) const {
        std::array<char, 40> number{};
        std::snprintf(number.data(), number.size(), ".%d.%06d", run, segment);
        const std::string suffix = path_.has_extension() ? path_.extension().string() : ".jsonl";
        return path_.parent_path() / (path_.stem().string() + number.data() + suffix);
    }
    bool open_segment() {
        const std::filesystem::path opened = file(run_, ++segment_);
        stream_ = std::fopen(opened.string().c_str(), "wb");
        if (stream_ == nullptr) {
            print_line("error", "cannot record to " + path_.string());
            return false;
        }
        std::fprintf(stream_, "{\"vicode-trace\": 1, \"runtime\": \"bica\", \"language\": \"cpp\", \"segment\": %d}\n", segment_);
        bytes_ = 0;
        std::error_code ignored;
        if (segment_ > static_cast<int>(segments_) + 1) {
            std::filesystem::remove(file(run_, segment_ - static_cast<int>(segments_) - 1), ignored);
        }
        return true;
    }
    /// Chooses the number of this run, and removes all but the latest earlier ones.
    void find_run() {
        std::error_code ignored;
        std::filesystem::create_directories(path_.parent_path(), ignored);
        std::map<int, std::vector<std::filesystem::path>> runs;
        for (const auto& entry : std::filesystem::directory_iterator(path_.parent_path(), ignored)) {
            const std::string name = entry.path().filename().string();
            int run = 0;
            int segment = 0;
            if (name.rfind(path_.stem().string() + ".", 0) == 0 && std::sscanf(name.c_str() + path_.stem().string().size(), ".%d.%d.", &run, &segment) == 2 && entry.path() == file(run, segment)) {
                runs[run].push_back(entry.path());
            }
        }
        run_ = runs.empty() ? 1 : runs.rbegin()->first + 1;
        while (runs.size() > kept_runs_) {
            for (const auto& old : runs.begin()->second) {
                std::filesystem::remove(old, ignored);
            }
            runs.erase(runs.begin());
        }
    }

    std::filesystem::path path_;
    Nanoseconds segment_ns_;
    Queue<Iteration> waiting_;
    std::int64_t dropped_ = 0;
    std::atomic<bool> is_closing_{false};
    bool has_failed_ = false;
    int run_ = 1;
    int segment_ = 0;
    std::FILE* stream_ = nullptr;
    std::size_t bytes_ = 0;
    Nanoseconds begin_ns_ = 0;
    double synced_s_ = 0.0;
    std::thread thread_;
};

// Requests

struct Place {
    const char* component = nullptr;  // null: an error
    std::string source{};
    std::string state{};
    std::string transition{};
    bool is_state = false;
    bool has_transition = false;
    std::string words{};

    bool is_reached(const Change& change) const {
        if (component == nullptr || std::strcmp(component, change.component) != 0 || state != change.target) {
            return false;
        }
        const bool is_same_id = has_transition ? change.transition != nullptr && transition == change.transition : change.transition == nullptr;
        return is_state || (is_same_id && (source.empty() || source == change.source));
    }
};

/// A checked request; the thread of the server makes and deletes it, that of the root applies it.
struct Request {
    std::function<void(class Robot& robot, Request& request)> apply{};
    std::uint64_t viewer = 0;
    bool has_answer = false;
    std::string id = "null";
    std::string done{};
    std::vector<Place> places{};
    // The answer of the thread of the root.
    Text error{};
    const char* before = nullptr;
    bool has_ended_pause = false;
};

/// The robot as its own thread sees it: publishes iterations, and applies requests between them.
class Robot final : public Observer {
public:
    static constexpr std::size_t most_handled = 4;

    Robot(Root& root, const Component& main, LiveProject project_, const LiveOptions& options_)
        : project(std::move(project_)), options(options_), main_name(main.name()), root_(root), next_(root.observer) {
        Iteration count;
        count.values.reserve(1 << 16);
        std::size_t fields = 0;
        for (const LiveComponent& each : project.components) {
            each.component->visit_values(count);
            each.component->visit_parameters(count);
            each.component->visit_inputs(count);
            fields += each.fields.all.size();
        }
        std::vector<Iteration> iterations = make_iterations(3, 4 * count.values.size() + 256);
        std::move(iterations.begin(), iterations.end(), iterations_.begin());
        if (!options.record.empty()) {
            const std::size_t kept = std::clamp<std::size_t>(most_waiting_bytes_ / iterations_[0].bytes(), 64, 4096);
            recorder_ = std::make_unique<Recorder>(options.record, options.minutes, make_iterations(kept, 4 * count.values.size() + 256));
        }
        active_.reserve(project.components.size() + 64);
        held_.reserve(fields);
        breakpoints_.reserve(128);
        root.observer = this;
    }
    Robot(const Robot&) = delete;
    Robot& operator=(const Robot&) = delete;
    ~Robot() { root_.observer = next_; }

    // The thread of the server

    /// The newest iteration if it was not taken yet; it is valid until the next call.
    const Iteration* take() {
        if ((mailbox_.load(std::memory_order_acquire) & is_new_) == 0) {
            return nullptr;
        }
        read_ = mailbox_.exchange(read_, std::memory_order_acq_rel) & ~is_new_;
        return &iterations_[static_cast<std::size_t>(read_)];
    }

    std::atomic<bool> is_watched{false};
    Queue<Change> changes{std::vector<Change>(512)};
    Queue<Text> log{std::vector<Text>(64)};
    /// The requests of one iteration: the server fills them in state 0, the robot answers in state 1, and sets 2.
    std::array<Request*, most_handled> requests{};
    std::atomic<int> requests_state{0};

    LiveProject project;
    const LiveOptions options;
    const char* main_name;

    // The thread of the root

    void begin_step(const Component& component, bool is_modulated, bool works) override {
        if (next_ != nullptr) {
            next_->begin_step(component, is_modulated, works);
        }
        if (depth_++ == 0) {
            begin_iteration();
        }
        if (!is_observing_) {
            return;
        }
        hold_values(component);
        Iteration& iteration = *writing();
        if (iteration.steps.size() == iteration.steps.capacity() || active_.size() == active_.capacity()) {
            active_.push_back(no_step_);
            return;
        }
        Step step;
        step.values.component = &component;
        step.by = active_.empty() || active_.back() == no_step_ ? nullptr : iteration.steps[active_.back()].values.component;
        step.is_modulated = is_modulated;
        step.worked = works;
        step.parameters.begin = iteration.values.size();
        if (is_modulated) {
            component.visit_parameters(iteration);
        }
        step.parameters.end = iteration.values.size();
        step.step_ns = clock_ns();
        active_.push_back(iteration.steps.size());
        iteration.steps.push_back(step);
    }

    bool replaces_step(Component& component) override {
        LiveComponent* shown = is_injecting_ ? find(component) : nullptr;
        if (shown != nullptr && shown->injected[0] != '\0') {
            const Text message = std::exchange(shown->injected, Text{});
            root_.report(component, message.data());
            return true;
        }
        return next_ != nullptr && next_->replaces_step(component);
    }

    void end_step(const Component& component) override {
        if (next_ != nullptr) {
            next_->end_step(component);
        }
        --depth_;
        if (!is_observing_) {
            return;
        }
        hold_values(component);
        if (component.left_state() != nullptr) {
            add_change(component);
        }
        const std::size_t position = active_.back();
        active_.pop_back();
        if (position != no_step_) {
            finish_step(writing()->steps[position], component);
        }
        if (depth_ == 0) {
            end_iteration();
        }
    }

    void error(const Component& component, const char* what) override {
        if (next_ != nullptr) {
            next_->error(component, what);
        } else if (root_.on_error == nullptr && component.errors == 1) {
            std::fprintf(stderr, "%s, state '%s': %s (reported once)\n", component.name(), component.state_name(), what);
        }
        ++errors_total_;
        Iteration& iteration = *writing();
        if (is_observing_ && iteration.errors.size() < Iteration::most_errors) {
            iteration.errors.push_back({&component, component.state_name(), {}});
            copy_text(iteration.errors.back().message, what);
        }
    }

    // What requests do

    bool was_stepped(const Component& component) const { return component.stepped_in() == last_iteration_; }

    void pause(std::uint64_t viewer, std::int64_t steps) {
        paused_by_ = viewer;
        steps_left_ = steps;
    }
    void hold_value(std::uint64_t viewer, const Component* component, const LiveField* field, const LiveValue& value) {
        unset(field);
        held_.push_back({viewer, component, field, value});
    }
    void unset(const LiveField* field) {
        held_.erase(std::remove_if(held_.begin(), held_.end(), [field](const Held& each) { return each.field == field; }), held_.end());
    }
    void inject(LiveComponent& component, const Text& message) {
        component.injected = message;
        is_injecting_ = true;
    }
    /// Replaces the breakpoints of a viewer; the old ones go back with the request, since this thread frees nothing.
    void set_breakpoints(Request& request) {
        auto found = std::find_if(breakpoints_.begin(), breakpoints_.end(), [&request](const Breakpoints& each) { return each.viewer == request.viewer; });
        if (found == breakpoints_.end()) {
            if (breakpoints_.size() == breakpoints_.capacity()) {
                copy_text(request.error, "too many viewers have breakpoints");
                return;
            }
            breakpoints_.push_back({request.viewer, {}});
            found = breakpoints_.end() - 1;
        }
        found->places.swap(request.places);
    }
    void release(Request& request) {
        if (paused_by_ == request.viewer) {
            pause(0, 0);
            request.has_ended_pause = true;
        }
        for (Breakpoints& each : breakpoints_) {
            if (each.viewer == request.viewer) {
                each.places.swap(request.places);
                std::swap(each, breakpoints_.back());
                breakpoints_.pop_back();
                break;
            }
        }
        held_.erase(std::remove_if(held_.begin(), held_.end(), [&request](const Held& each) { return each.viewer == request.viewer; }), held_.end());
        hold();
    }

private:
    static constexpr int is_new_ = 4;
    static constexpr std::size_t most_waiting_bytes_ = 32'000'000;
    static constexpr std::size_t no_step_ = static_cast<std::size_t>(-1);

    struct Held {
        std::uint64_t viewer;
        const Component* component;
        const LiveField* field;
        LiveValue value;
    };
    struct Breakpoints {
        std::uint64_t viewer;
        std::vector<Place> places;
    };

    std::vector<Iteration> make_iterations(std::size_t count, std::size_t most_values) const {
        std::vector<Iteration> iterations(count);
        for (Iteration& each : iterations) {
            each.reserve(4 * project.components.size() + 32, most_values, project.components.size());
        }
        return iterations;
    }
    LiveComponent* find(const Component& component) {
        const auto found = std::find_if(project.components.begin(), project.components.end(), [&component](const LiveComponent& each) { return each.component == &component; });
        return found != project.components.end() ? &*found : nullptr;
    }
    Iteration* writing() { return &iterations_[static_cast<std::size_t>(write_)]; }

    void begin_iteration() {
        last_iteration_ = root_.iteration() - 1;
        apply_requests();
        is_observing_ = recorder_ != nullptr || is_watched.load(std::memory_order_acquire);
        if (!is_observing_) {
            return;
        }
        active_.clear();
        Iteration& iteration = *writing();
        iteration.clear();
        for (const Component* each : project.inputs) {
            const std::size_t begin = iteration.values.size();
            each->visit_inputs(iteration);
            if (iteration.values.size() > begin) {
                iteration.inputs.push_back({each, begin, iteration.values.size()});
            }
        }
        reached_ = nullptr;
    }

    void finish_step(Step& step, const Component& component) {
        Iteration& iteration = *writing();
        step.state = component.state_name();
        step.state_time_ns = component.state_time_ns();
        step.component_time_ns = component.component_time_ns();
        step.changed_from = component.left_state();
        step.transition = component.transition();
        step.done = component.is_done();
        if (const LiveComponent* shown = find(component)) {
            step.action_done = static_cast<signed char>(shown->action_done == nullptr ? -1 : shown->action_done(component));
            step.conflict = static_cast<signed char>(shown->conflict == nullptr ? -1 : shown->conflict(component));
        }
        step.values.begin = iteration.values.size();
        component.visit_values(iteration);
        step.values.end = iteration.values.size();
        step.step_ns = clock_ns() - step.step_ns;
    }

    void add_change(const Component& component) {
        const Change change{++change_count_, root_.iteration(), root_.now_ns(), component.name(), component.left_state(), component.state_name(), component.transition()};
        changes.add(change);
        check_breakpoints([&change](const Place& place) { return place.is_reached(change); });
    }
    template <class Reached>
    void check_breakpoints(Reached is_reached) {
        for (const Breakpoints& each : breakpoints_) {
            for (const Place& place : each.places) {
                if (is_reached(place) && (reached_ == nullptr || place.words < reached_->words)) {
                    reached_ = &place;
                    reached_by_ = each.viewer;
                }
            }
        }
    }

    void end_iteration() {
        Iteration& iteration = *writing();
        for (const LiveComponent& each : project.components) {
            if (each.component->stepped_in() == root_.iteration() - 1 && each.component->is_done()) {
                iteration.still_done.push_back(each.component);
            }
        }
        steps_left_ -= steps_left_ > 0 ? 1 : 0;
        if (!iteration.errors.empty()) {
            check_breakpoints([](const Place& place) { return place.component == nullptr; });
        }
        if (reached_ != nullptr) {
            pause(reached_by_, 0);
            Text words{};
            std::snprintf(words.data(), words.size(), "paused at the breakpoint %s", reached_->words.c_str());
            log.add(words);
        }
        Head& head = iteration.head;
        head.iteration = root_.iteration();
        head.time_ns = root_.now_ns();
        head.team_size = root_.team.size;
        head.errors_total = errors_total_;
        head.is_paused = false;
        if (recorder_ != nullptr) {
            recorder_->add(iteration);
        }
        if (is_paused()) {
            wait_while_paused(iteration);
        } else if (is_watched.load(std::memory_order_relaxed)) {
            publish(iteration);
        }
    }
    bool is_paused() const { return paused_by_ != 0 && steps_left_ == 0; }

    void publish(Iteration& iteration) {
        iteration.head.number = ++number_;
        write_ = mailbox_.exchange(write_ | is_new_, std::memory_order_acq_rel) & ~is_new_;
    }

    /// Holds the robot and applies requests until one of them continues; no time passes.
    void wait_while_paused(Iteration& iteration) {
        const Nanoseconds begin = options.clock();
        hold();
        iteration.head.is_paused = true;
        publish(iteration);
        last_iteration_ = root_.iteration();
        while (is_paused() && is_watched.load(std::memory_order_acquire) && !(options.is_stopping && options.is_stopping())) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            apply_requests();
        }
        root_.skip_time(options.clock() - begin);
    }

    void apply_requests() {
        if (requests_state.load(std::memory_order_acquire) != 1) {
            return;
        }
        for (Request* request : requests) {
            if (request != nullptr) {
                call(request->error, [this, request] { request->apply(*this, *request); });
            }
        }
        requests_state.store(2, std::memory_order_release);
    }
    void hold() {
        Text error{};
        if (options.hold) {
            call(error, options.hold);
        }
        if (error[0] != '\0') {
            log.add({"hold() failed; the robot may move"});
        }
    }
    /// Calls code of the program, which may throw.
    template <class Call>
    static void call([[maybe_unused]] Text& error, const Call& code) {
#if defined(__cpp_exceptions)
        try {
            code();
        } catch (const std::exception& thrown) {
            copy_text(error, thrown.what());
        } catch (...) {
            copy_text(error, "unknown exception");
        }
#else
        code();
#endif
    }
    void hold_values(const Component& component) {
        for (const Held& each : held_) {
            if (each.component == &component) {
                each.field->write(each.field->place, each.value);
            }
        }
    }

    Root& root_;
    Observer* next_;
    std::unique_ptr<Recorder> recorder_;
    std::array<Iteration, 3> iterations_{};
    std::atomic<int> mailbox_{0};
    int write_ = 1;
    int read_ = 2;
    std::vector<std::size_t> active_;
    std::size_t depth_ = 0;
    bool is_observing_ = false;
    std::int64_t last_iteration_ = 0;
    std::int64_t number_ = 0;
    std::int64_t change_count_ = 0;
    std::int64_t errors_total_ = 0;
    std::uint64_t paused_by_ = 0;
    std::int64_t steps_left_ = 0;
    std::vector<Held> held_;
    bool is_injecting_ = false;
    std::vector<Breakpoints> breakpoints_;
    const Place* reached_ = nullptr;
    std::uint64_t reached_by_ = 0;
};

/// Checks requests in the thread of the server, and says what is wrong with them.
class RequestParser {
public:
    RequestParser(Robot& robot, const Json& json) : project_(robot.project), json_(json) {}

    /// Why the request cannot be applied; empty if it can.
    std::string error;

    std::unique_ptr<Request> parse() {
        request_ = std::make_unique<Request>();
        request_->has_answer = json_.members.count("id") != 0;
        request_->id = request_->has_answer ? json_["id"].raw : "null";
        const std::string asked = json_["do"].words();
        using Parse = void (RequestParser::*)();
        static const std::vector<std::pair<const char*, Parse>> known = {
            {"pause", &RequestParser::parse_pause}, {"resume", &RequestParser::parse_resume}, {"step", &RequestParser::parse_step},
            {"break", &RequestParser::parse_break}, {"set", &RequestParser::parse_set}, {"unset", &RequestParser::parse_unset},
            {"enter", &RequestParser::parse_enter}, {"raise", &RequestParser::parse_raise}, {"frequency", &RequestParser::parse_frequency},
            {"tune", &RequestParser::parse_tune}, {"release", &RequestParser::parse_release}};
        std::string names;
        for (const auto& [name, parse] : known) {
            names += (names.empty() ? "" : ", ") + std::string(name);
            if (json_["do"].kind == Json::Kind::text && asked == name) {
                (this->*parse)();
                return std::move(request_);
            }
        }
        error = "unknown request " + shown(json_["do"]) + "; known are " + names;
        return nullptr;
    }

    static std::string shown(const Json& value) { return value.kind == Json::Kind::text ? "'" + value.text + "'" : value.words(); }

private:
    void parse_pause() { finish("paused", [](Robot& robot, Request& request) { robot.pause(request.viewer, 0); }); }
    void parse_resume() { finish("resumed", [](Robot& robot, Request&) { robot.pause(0, 0); }); }
    void parse_release() { finish("", [](Robot& robot, Request& request) { robot.release(request); }); }
    void parse_step() {
        const Json& given = json_["count"];
        const bool is_given = !given.raw.empty();
        if (is_given && (given.kind != Json::Kind::integer || given.number < 1 || given.number > 1e6)) {
            error = "'count' must be a whole number from 1";
            return;
        }
        const auto count = is_given ? static_cast<std::int64_t>(given.number) : 1;
        finish("runs " + std::to_string(count) + " iteration" + (count == 1 ? "" : "s"), [count](Robot& robot, Request& request) { robot.pause(request.viewer, count); });
    }
    void parse_break() {
        std::string words;
        const Json& places = json_["places"];
        if (places.kind != Json::Kind::list || !std::all_of(places.items.begin(), places.items.end(), is_place)) {
            error = "'places' must be a list of [component, state] or [component, source, target, id]";
            return;
        }
        std::vector<Place>& read = request_->places;
        for (auto each = places.items.begin(); each != places.items.end() && error.empty(); ++each) {
            read.push_back(read_place(*each));
            words += read.size() <= 10 ? (words.empty() ? "" : ", ") + read.back().words : "";
        }
        words += read.size() > 10 ? " and " + std::to_string(read.size() - 10) + " more" : "";
        finish("breakpoints: " + (words.empty() ? "none" : words), [](Robot& robot, Request& request) { robot.set_breakpoints(request); });
    }
    static bool is_place(const Json& place) {
        const auto is_text = [](const Json& each) { return each.kind == Json::Kind::text; };
        const std::size_t count = place.items.size();
        return (count == 2 || count == 4) && std::all_of(place.items.begin(), place.items.begin() + (count == 2 ? 2 : 3), is_text) && (count == 2 || is_text(place.items[3]) || place.items[3].kind == Json::Kind::null);
    }
    Place read_place(const Json& json) {
        const bool is_state = json.items.size() == 2;
        const std::string source = is_state ? "" : json.items[1].text;
        const std::string state = json.items[is_state ? 1 : 2].text;
        const LiveComponent* component = json.items[0].text.empty() ? nullptr : find_component(json.items[0]);
        if (component == nullptr) {
            return {nullptr, "", "", "", is_state, false, "errors"};
        }
        for (const std::string& each : {source, state}) {
            if (!each.empty() && find_state(*component, each) == component->states.size() && error.empty()) {
                error = json.items[0].text + " has no state '" + each + "'";
            }
        }
        const auto named = [](const std::string& name) { return name.empty() ? "any state" : name; };
        const std::string words = name_of(*component) + " " + (is_state ? "" : named(source) + " → ") + named(state);
        const bool has_transition = !is_state && json.items[3].kind == Json::Kind::text;
        return {component->component->name(), source, state, has_transition ? json.items[3].text : "", is_state, has_transition, words};
    }
    void parse_set() {
        LiveComponent* component = find_component();
        const LiveField* field = component != nullptr ? find_field(component->fields) : nullptr;
        if (field == nullptr) {
            error = component != nullptr ? name_of(*component) + " has no value '" + json_["name"].words() + "' that can be set" : error;
            return;
        }
        const bool is_held = json_["hold"].boolean;
        const std::string name = name_of(*component) + "." + field->name;
        LiveValue value;
        if (convert(*field, name, value)) {
            finish((is_held ? "holds " : "set ") + name + " = " + plain_text(value), [component, field, value, is_held](Robot& robot, Request& request) {
                field->write(field->place, value);
                if (is_held) {
                    robot.hold_value(request.viewer, component->component, field, value);
                }
            });
        }
    }
    void parse_unset() {
        const LiveComponent* component = find_component();
        const LiveField* field = component != nullptr ? find_field(component->fields) : nullptr;
        error.clear();
        finish("released " + json_["component"].words() + "." + json_["name"].words(), [field](Robot& robot, Request&) { robot.unset(field); });
    }
    void parse_enter() {
        LiveComponent* component = find_component();
        if (component == nullptr) {
            return;
        }
        const std::string asked = json_["state"].words();
        const std::size_t state = find_state(*component, asked);
        if (state == component->states.size()) {
            error = name_of(*component) + " has no state '" + asked + "'";
            return;
        }
        finish(name_of(*component) + ": … → " + asked, [component, state](Robot& robot, Request& request) {
            Component& target = *component->component;
            if (!robot.was_stepped(target)) {
                std::snprintf(request.error.data(), request.error.size(), "%s is not active: it was not stepped in the last iteration", target.name());
                return;
            }
            request.before = target.state_name();
            component->enter(target, state);
        });
    }
    void parse_raise() {
        LiveComponent* component = find_component();
        if (component == nullptr) {
            return;
        }
        const Json& given = json_["message"];
        const std::string message = given.raw.empty() || given.words().empty() ? "injected error" : given.words();
        Text text{};
        copy_text(text, ("InjectedError: " + message).c_str());
        finish("the next step of " + name_of(*component) + " raises: " + message.substr(0, 200), [component, text](Robot& robot, Request&) { robot.inject(*component, text); });
    }
    void parse_frequency() {
        LiveComponent* component = find_component();
        const Json& hertz = json_["hz"];
        if (component == nullptr) {
            return;
        }
        if (!hertz.is_number() || !(hertz.number >= 0.001 && hertz.number <= 10'000.0)) {
            error = "'hz' must be a number from 0.001 to 10000";
        } else if (!component->states.empty() && component->frequency_hz == 0.0) {
            error = name_of(*component) + " has no frequency in its design, so its generated code cannot have another one";
        } else {
            std::array<char, 32> words{};
            std::snprintf(words.data(), words.size(), "%g", hertz.number);
            finish(name_of(*component) + " works at " + words.data() + " Hz", [component, hz = hertz.number](Robot&, Request&) { component->component->set_frequency(hz); });
        }
    }
    void parse_tune() {
        const std::string name = json_["name"].words();
        const LiveField* field = find_field(project_.constants);
        LiveValue value;
        if (field == nullptr) {
            error = "no component uses a constant '" + name + "' that is tunable";
        } else if (convert(*field, name, value)) {
            error = std::isfinite(value.number) ? "" : name + " must be a finite number";
            finish("constant " + name + " = " + plain_text(value), [field, value](Robot&, Request&) { field->write(field->place, value); });
        }
    }

    void finish(const std::string& done, std::function<void(Robot&, Request&)> apply) {
        request_->done = done;
        request_->apply = std::move(apply);
    }
    static std::string name_of(const LiveComponent& component) { return component.component->name(); }
    LiveComponent* find_component() { return find_component(json_["component"]); }
    LiveComponent* find_component(const Json& name) {
        for (LiveComponent& each : project_.components) {
            if (name.kind == Json::Kind::text && name.text == each.component->name()) {
                return &each;
            }
        }
        error = "no component " + shown(name);
        return nullptr;
    }
    static std::size_t find_state(const LiveComponent& component, const std::string& name) {
        return static_cast<std::size_t>(std::find(component.states.begin(), component.states.end(), name) - component.states.begin());
    }
    const LiveField* find_field(const LiveFields& fields) const {
        const auto found = std::find_if(fields.all.begin(), fields.all.end(), [this](const LiveField& each) { return json_["name"].words() == each.name; });
        return found != fields.all.end() ? &*found : nullptr;
    }
    /// Converts the value of the request to the type of a field.
    bool convert(const LiveField& field, const std::string& name, LiveValue& value) {
        const Json& given = json_["value"];
        const bool is_infinite = given.text == "inf" || given.text == "-inf";
        value.kind = field.kind;
        value.type = field.type;
        switch (field.kind) {
            case LiveValue::Kind::boolean:
                value.integer = given.boolean ? 1 : 0;
                return check(given.kind == Json::Kind::boolean, name, "bool");
            case LiveValue::Kind::integer:
                value.integer = limit(saturate(given.number));
                return check(given.kind == Json::Kind::integer, name, "int");
            case LiveValue::Kind::number:
                value.number = is_infinite ? std::copysign(infinity, given.text[0] == '-' ? -1.0 : 1.0) : given.text == "nan" ? nan : given.number;
                return check(given.is_number() || is_infinite || given.text == "nan", name, "float");
            case LiveValue::Kind::element:
                break;
        }
        std::string known;
        for (std::size_t index = 0; index < field.elements.size(); ++index) {
            const std::string element = std::string(field.type) + "." + field.elements[index];
            known += (known.empty() ? "" : ", ") + element;
            if (given.text == element || given.text == field.elements[index]) {
                value.integer = static_cast<std::int64_t>(index);
                value.element = field.elements[index];
                return true;
            }
        }
        error = name + " must be one of " + known;
        return false;
    }
    bool check(bool is_valid, const std::string& name, const char* type) {
        error = is_valid ? "" : name + " must be a value of type " + type;
        return is_valid;
    }
    static std::string plain_text(const LiveValue& value) {
        std::string text = value_text(value);
        text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
        return value.kind == LiveValue::Kind::boolean ? (value.integer != 0 ? "True" : "False") : text;
    }

    LiveProject& project_;
    const Json& json_;
    std::unique_ptr<Request> request_;
};

// Sockets

#if defined(_WIN32)
using Socket = SOCKET;
inline constexpr Socket no_socket = INVALID_SOCKET;
using PollItem = WSAPOLLFD;
inline int poll_sockets(std::vector<PollItem>& items, int wait_ms) { return WSAPoll(items.data(), static_cast<ULONG>(items.size()), wait_ms); }
inline void close_socket(Socket socket) { closesocket(socket); }
inline bool would_block() { return WSAGetLastError() == WSAEWOULDBLOCK; }
inline void unblock(Socket socket) {
    u_long yes = 1;
    ioctlsocket(socket, FIONBIO, &yes);
}
inline std::ptrdiff_t send_some(Socket socket, const std::string& text) { return ::send(socket, text.data(), static_cast<int>(text.size()), 0); }
inline std::ptrdiff_t receive_some(Socket socket, char* bytes, std::size_t size) { return ::recv(socket, bytes, static_cast<int>(size), 0); }
#else
using Socket = int;
inline constexpr Socket no_socket = -1;
using PollItem = pollfd;
inline int poll_sockets(std::vector<PollItem>& items, int wait_ms) { return ::poll(items.data(), static_cast<nfds_t>(items.size()), wait_ms); }
inline void close_socket(Socket socket) { ::close(socket); }
inline bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }
inline void unblock(Socket socket) {
    ::fcntl(socket, F_SETFL, ::fcntl(socket, F_GETFL, 0) | O_NONBLOCK);
    ::fcntl(socket, F_SETFD, FD_CLOEXEC);
}
#if !defined(MSG_NOSIGNAL)
#define BICA_SEND_FLAGS 0
#else
#define BICA_SEND_FLAGS MSG_NOSIGNAL
#endif
inline std::ptrdiff_t send_some(Socket socket, const std::string& text) { return ::send(socket, text.data(), text.size(), BICA_SEND_FLAGS); }
inline std::ptrdiff_t receive_some(Socket socket, char* bytes, std::size_t size) { return ::recv(socket, bytes, size, 0); }
#endif

/// An amount that grows with time, up to a limit.
class Allowance {
public:
    Allowance(double per_s, double most) : per_s_(per_s), most_(most), left_(most), at_s_(now_s()) {}
    void use(double amount) { left_ -= amount; }
    /// Seconds until at least 1 is left.
    double wait_s() {
        const double now = now_s();
        left_ = std::min(most_, left_ + (now - at_s_) * per_s_);
        at_s_ = now;
        return left_ >= 1.0 ? 0.0 : (1.0 - left_) / per_s_;
    }

private:
    double per_s_;
    double most_;
    double left_;
    double at_s_;
};

/// A connection; what it may send is limited as in Python.
struct Viewer {
    static constexpr std::size_t most_line_bytes = 65'536;
    static constexpr std::size_t received_bytes = 4'096;

    Socket socket = no_socket;
    std::uint64_t id = 0;
    double connected_s = now_s();
    std::string unsent{};
    std::string received{};
    bool is_admitted = false;
    bool has_control = false;
    bool is_lost = false;
    bool has_received_all = true;
    double period_s = 1.0 / 30.0;
    double due_s = 0.0;
    double resume_s = 0.0;
    double limited_since_s = 0.0;
    std::string focus{};
    std::int64_t seen_number = 0;
    std::int64_t seen_iteration = 0;
    std::int64_t seen_change = 0;
    Allowance lines{100.0, 100.0};
    Allowance bytes{32'768.0, static_cast<double>(most_line_bytes + received_bytes)};
};

/// Serves one robot: a thread that waits for sockets, and looks for new iterations while somebody watches.
class Server {
public:
    explicit Server(Robot& robot) : robot_(robot), name_(robot.options.name.empty() ? robot.main_name : robot.options.name), token_(robot.options.token) {}
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server() {
        is_closing_.store(true, std::memory_order_release);
        robot_.is_watched.store(false, std::memory_order_release);
        if (thread_.joinable()) {
            thread_.join();
        }
        for (Viewer& viewer : viewers_) {
            close_socket(viewer.socket);
        }
        if (listener_ != no_socket) {
            close_socket(listener_);
        }
        if (!path_.empty()) {
            std::error_code ignored;
            std::filesystem::remove(path_, ignored);
        }
        for (Request* request : robot_.requests) {
            delete request;
        }
    }

    /// Opens the address; returns what went wrong, or nothing.
    std::string open(const std::string& address) {
#if defined(_WIN32)
        WSADATA data;
        WSAStartup(MAKEWORD(2, 2), &data);
#endif
        const bool is_open = address.rfind("unix:", 0) == 0 ? listen_unix(address.substr(5)) : listen_tcp(address);
        if (!is_open) {
            return "cannot be watched at " + address + (problem_.empty() ? std::string(": ") + std::strerror(errno) : problem_);
        }
        if (token_.empty() && path_.empty()) {
            std::random_device chance;
            for (int index = 0; index < 6; ++index) {
                std::array<char, 8> digits{};
                std::snprintf(digits.data(), digits.size(), "%04x", chance() & 0xffffU);
                token_ += digits.data();
            }
        }
        ::listen(listener_, 64);
        unblock(listener_);
        print_line("watch", "vicode attach " + address_ + (token_.empty() ? "" : " --token " + token_));
        thread_ = std::thread([this] { serve(); });
        return "";
    }

private:
    static constexpr std::size_t most_viewers_ = 32;
    static constexpr std::size_t most_unsent_ = 1'000'000;
    static constexpr std::size_t most_waiting_ = 64;
    static constexpr std::size_t most_changes_ = 256;

    bool listen_tcp(const std::string& address) {
        const std::size_t colon = address.rfind(':');
        const std::string host = colon == std::string::npos || colon == 0 ? "127.0.0.1" : address.substr(0, colon);
        const std::string port = colon == std::string::npos ? address : address.substr(colon + 1);
        addrinfo hints{};
        hints.ai_socktype = SOCK_STREAM;
        hints.ai_flags = AI_PASSIVE;
        addrinfo* found = nullptr;
        if (port.empty() || port.find_first_not_of("0123456789") != std::string::npos || ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) {
            problem_ = ": write PORT, HOST:PORT or unix:PATH";
            return false;
        }
        listener_ = ::socket(found->ai_family, SOCK_STREAM, 0);
        const int yes = 1;
#if defined(_WIN32)
        ::setsockopt(listener_, SOL_SOCKET, SO_EXCLUSIVEADDRUSE, reinterpret_cast<const char*>(&yes), sizeof(yes));
#else
        ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
#endif
        const bool is_bound = listener_ != no_socket && ::bind(listener_, found->ai_addr, static_cast<socklen_t>(found->ai_addrlen)) == 0;
        ::freeaddrinfo(found);
        sockaddr_storage name{};
        socklen_t size = sizeof(name);
        if (is_bound && ::getsockname(listener_, reinterpret_cast<sockaddr*>(&name), &size) == 0) {
            std::array<char, 64> host_text{};
            std::array<char, 16> port_text{};
            ::getnameinfo(reinterpret_cast<sockaddr*>(&name), size, host_text.data(), host_text.size(), port_text.data(), port_text.size(), NI_NUMERICHOST | NI_NUMERICSERV);
            address_ = std::string(host_text.data()) + ":" + port_text.data();
        }
        return is_bound;
    }

#if defined(_WIN32)
    bool listen_unix(const std::string&) {
        problem_ = ": Windows has no such addresses here; write PORT or HOST:PORT";
        return false;
    }
#else
    bool listen_unix(const std::string& path) {
        sockaddr_un name{};
        name.sun_family = AF_UNIX;
        if (path.empty() || path.size() >= sizeof(name.sun_path)) {
            problem_ = ": the path is too long";
            return false;
        }
        std::memcpy(name.sun_path, path.c_str(), path.size());
        const auto* address = reinterpret_cast<const sockaddr*>(&name);
        const Socket probe = ::socket(AF_UNIX, SOCK_STREAM, 0);
        const bool is_in_use = ::connect(probe, address, sizeof(name)) == 0;
        close_socket(probe);
        if (is_in_use) {
            problem_ = ": it is in use by another program";
            return false;
        }
        std::error_code ignored;
        if (std::filesystem::is_socket(path, ignored)) {
            std::filesystem::remove(path, ignored);  // a program that was killed left it
        }
        listener_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
        // Nobody can connect before `listen`, so nobody sees it with other permissions.
        if (::bind(listener_, address, sizeof(name)) != 0 || ::chmod(path.c_str(), 0600) != 0) {
            return false;
        }
        path_ = path;
        address_ = "unix:" + path;
        return true;
    }
#endif

    void serve() {
#if !defined(_WIN32)
        sigset_t all;  // signals are for the threads of the program
        sigfillset(&all);
        pthread_sigmask(SIG_BLOCK, &all, nullptr);
#endif
        while (!is_closing_.load(std::memory_order_acquire)) {
            wait();
            for (Viewer& viewer : viewers_) {
                if (viewer.resume_s != 0.0 && now_s() >= viewer.resume_s) {
                    read_lines(viewer);
                }
            }
            hand_over_requests();
            deliver();
            drop_lost();
        }
    }

    void wait() {
        std::vector<PollItem> items;
        const bool accepts = now_s() >= accept_s_;
        items.push_back({accepts ? listener_ : no_socket, POLLIN, 0});
        for (const Viewer& viewer : viewers_) {
            const int wanted = (viewer.resume_s == 0.0 ? POLLIN : 0) | (viewer.unsent.empty() ? 0 : POLLOUT);
            items.push_back({wanted != 0 ? viewer.socket : no_socket, static_cast<short>(wanted), 0});
        }
        const std::size_t count = viewers_.size();
        const bool is_waiting = !waiting_.empty() || robot_.requests_state.load(std::memory_order_relaxed) != 0;
        poll_sockets(items, is_waiting ? 1 : count != 0 ? 5 : 100);
        for (std::size_t index = 0; index < count; ++index) {
            Viewer& viewer = viewers_[index];
            if ((items[index + 1].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
                receive(viewer);
            }
            if ((items[index + 1].revents & POLLOUT) != 0) {
                write(viewer);
            }
        }
        if (accepts && (items[0].revents & POLLIN) != 0) {
            accept();
        }
    }

    void accept() {
        connections_.use(1);
        accept_s_ = now_s() + connections_.wait_s();
        const Socket socket = ::accept(listener_, nullptr, nullptr);
        if (socket == no_socket) {
            return;
        }
        if (viewers_.size() >= most_viewers_) {
            // Connections without a token must not keep viewers out.
            const auto stranger = std::find_if(viewers_.begin(), viewers_.end(), [](const Viewer& each) { return !each.is_admitted; });
            if (stranger == viewers_.end()) {
                close_socket(socket);
                return;
            }
            stranger->is_lost = true;
            drop_lost();
        }
        unblock(socket);
        if (path_.empty()) {
            const int yes = 1;
            ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&yes), sizeof(yes));
        }
        Viewer viewer;
        viewer.socket = socket;
        viewer.id = ++last_id_;
        viewers_.push_back(std::move(viewer));
    }

    void receive(Viewer& viewer) {
        std::array<char, Viewer::received_bytes> bytes;
        const std::ptrdiff_t count = receive_some(viewer.socket, bytes.data(), bytes.size());
        if (count <= 0) {
            viewer.is_lost = viewer.is_lost || count == 0 || !would_block();
            return;
        }
        viewer.has_received_all = static_cast<std::size_t>(count) < bytes.size();
        viewer.bytes.use(static_cast<double>(count));
        viewer.received.append(bytes.data(), static_cast<std::size_t>(count));
        viewer.is_lost = viewer.is_lost || (viewer.received.size() > Viewer::most_line_bytes && viewer.received.find('\n') == std::string::npos);
        read_lines(viewer);
    }

    /// Handles the lines that a viewer may send now; sets `resume_s`, when to go on.
    void read_lines(Viewer& viewer) {
        std::size_t end = 0;
        for (int count = 0; count < 8 && !viewer.is_lost && viewer.lines.wait_s() == 0.0; ++count) {
            end = viewer.received.find('\n');
            if (end == std::string::npos) {
                break;
            }
            const std::string line = viewer.received.substr(0, end);
            viewer.received.erase(0, end + 1);
            viewer.lines.use(1);
            viewer.is_lost = !read_line(viewer, line) || viewer.is_lost;
        }
        const bool has_more = viewer.received.find('\n') != std::string::npos;
        const double waiting_s = std::max(viewer.bytes.wait_s(), has_more ? viewer.lines.wait_s() : 0.0);
        const double now = now_s();
        viewer.resume_s = has_more || waiting_s != 0.0 ? now + waiting_s : 0.0;
        if (viewer.resume_s == 0.0 && viewer.has_received_all) {
            viewer.limited_since_s = 0.0;
        } else if (waiting_s != 0.0 && viewer.limited_since_s == 0.0) {
            viewer.limited_since_s = now;
        }
        if (viewer.limited_since_s != 0.0 && now - viewer.limited_since_s > 5.0) {
            send(viewer, "{\"error\":\"more requests than a robot answers, for 5 s\"}\n");
            viewer.is_lost = true;
        }
    }

    /// Returns whether the viewer may stay.
    bool read_line(Viewer& viewer, const std::string& line) {
        const auto count = std::count(line.begin(), line.end(), '[') + std::count(line.begin(), line.end(), '{');
        Json json;
        if (count > 256 || !JsonReader(line).parse(json) || json.kind != Json::Kind::object) {
            return false;
        }
        if (!viewer.is_admitted) {
            return admit(viewer, json);
        }
        if (json.members.count("focus") != 0) {
            viewer.focus = json["focus"].words();
            return true;
        }
        const bool has_id = json.members.count("id") != 0;
        const std::string id = has_id ? json["id"].raw : "null";
        if (json["robot"].text != name_) {
            answer(viewer, id, "error", "no robot " + RequestParser::shown(json["robot"]));
        } else if (!robot_.options.control) {
            answer(viewer, id, "error", "this robot may only be watched; start it with control");
        } else {
            viewer.has_control = true;
            RequestParser parser(robot_, json);
            std::unique_ptr<Request> request = parser.parse();
            if (!parser.error.empty()) {
                if (has_id) {
                    answer(viewer, id, "error", parser.error);
                }
            } else if (waiting_.size() + handed_over_ >= most_waiting_) {
                answer(viewer, id, "error", "too many requests at once; the robot did not handle this one");
            } else {
                request->viewer = viewer.id;
                waiting_.push_back(std::move(request));
            }
        }
        return true;
    }

    bool admit(Viewer& viewer, const Json& json) {
        const std::string& given = json["token"].text;
        unsigned difference = given.size() == token_.size() ? 0 : 1;
        for (std::size_t index = 0; index < token_.size(); ++index) {
            difference |= static_cast<unsigned char>(token_[index]) ^ static_cast<unsigned>(index < given.size() ? static_cast<unsigned char>(given[index]) : 0U);
        }
        if (!token_.empty() && difference != 0) {
            send(viewer, "{\"error\":\"wrong token\"}\n");
            return false;
        }
        const Json& rate = json["rate_hz"];
        viewer.period_s = rate.is_number() && rate.number >= 0.01 && rate.number <= 200.0 ? 1.0 / rate.number : viewer.period_s;
        viewer.is_admitted = true;
        send(viewer, describe());
        return true;
    }

    std::string describe() const {
        std::string text = std::string("{\"vicode-live\":1,\"control\":") + (robot_.options.control ? "true" : "false");
        text += ",\"robots\":[{\"name\":" + json_text(name_) + ",\"root\":" + json_text(robot_.main_name) + ",\"language\":\"cpp\",\"components\":{";
        for (const LiveComponent& each : robot_.project.components) {
            text += (text.back() == '{' ? "" : ",") + json_text(each.component->name()) + ":{\"design\":" + json_text(each.design) + ",\"code\":" + json_text(each.code) + ",\"states\":[";
            for (const char* state : each.states) {
                text += (text.back() == '[' ? "" : ",") + json_text(state);
            }
            text += "],\"frequency_hz\":" + (each.frequency_hz == 0.0 ? "null" : number_text(each.frequency_hz)) + "}";
        }
        text += "},\"shared\":{";
        for (const auto& [file, code] : robot_.project.shared) {
            text += (text.back() == '{' ? "" : ",") + json_text(file) + ":" + json_text(code);
        }
        return text + "}}]}\n";
    }

    /// Gives the robot the next requests, and answers those that it has handled.
    void hand_over_requests() {
        if (robot_.requests_state.load(std::memory_order_acquire) == 2) {
            for (Request*& each : robot_.requests) {
                if (each != nullptr) {
                    report(std::unique_ptr<Request>(std::exchange(each, nullptr)));
                }
            }
            handed_over_ = 0;
            robot_.requests_state.store(0, std::memory_order_relaxed);
        }
        if (robot_.requests_state.load(std::memory_order_relaxed) == 0 && !waiting_.empty()) {
            for (Request*& each : robot_.requests) {
                if (!waiting_.empty()) {
                    each = waiting_.front().release();
                    waiting_.pop_front();
                    ++handed_over_;
                }
            }
            robot_.requests_state.store(1, std::memory_order_release);
        }
        Text words;
        while (robot_.log.take(words)) {
            print_line("control", name_ + ": " + words.data());
        }
    }
    void report(std::unique_ptr<Request> request) {
        const bool has_failed = request->error[0] != '\0';
        std::string done = request->done;
        if (request->before != nullptr) {
            done.replace(done.find("…"), std::strlen("…"), request->before);
        } else if (request->has_ended_pause) {
            done = "resumed, as the viewer that paused has left";
        }
        if (!has_failed && !done.empty()) {
            print_line("control", name_ + ": " + done);
        }
        const auto viewer = std::find_if(viewers_.begin(), viewers_.end(), [&request](const Viewer& each) { return each.id == request->viewer; });
        if (request->has_answer && viewer != viewers_.end()) {
            answer(*viewer, request->id, has_failed ? "error" : done.empty() ? "" : "done", has_failed ? request->error.data() : done);
        }
    }
    void answer(Viewer& viewer, const std::string& id, const char* kind, const std::string& words) {
        send(viewer, "{\"answer\":" + id + ",\"robot\":" + json_text(name_) + (*kind == '\0' ? "" : std::string(",\"") + kind + "\":" + json_text(words)) + "}\n");
    }

    void deliver() {
        bool is_watched = false;
        if (const Iteration* taken = robot_.take()) {
            newest_ = taken;
            with_values_.clear();
            without_values_.clear();
        }
        Change change;
        while (robot_.changes.take(change)) {
            changes_.push_back(change);
            if (changes_.size() > most_changes_) {
                changes_.pop_front();
            }
        }
        const double now = now_s();
        for (Viewer& viewer : viewers_) {
            is_watched = is_watched || viewer.is_admitted;
            viewer.is_lost = viewer.is_lost || (!viewer.is_admitted && now - viewer.connected_s > 5.0);
            if (newest_ != nullptr && viewer.is_admitted && viewer.unsent.empty() && now >= viewer.due_s && newest_->head.number != viewer.seen_number) {
                send_newest(viewer, now);
            }
        }
        if (!is_watched) {
            // The next viewer must not take it for the present.
            newest_ = nullptr;
        }
        robot_.is_watched.store(is_watched, std::memory_order_release);
    }

    void send_newest(Viewer& viewer, double now) {
        const bool is_shown = viewer.focus.empty() || viewer.focus == name_;
        std::string& text = is_shown ? with_values_ : without_values_;
        const Head& head = newest_->head;
        if (text.empty()) {
            text = Writer(*newest_, is_shown, true).write() + ",\"robot\":" + json_text(name_) + ",\"paused\":" + (head.is_paused ? "true" : "false") + ",\"errors_total\":" + std::to_string(head.errors_total);
        }
        std::string changes;
        for (const Change& each : changes_) {
            if (each.number > viewer.seen_change) {
                changes += (changes.empty() ? "" : ",") + std::string("{\"number\":") + std::to_string(each.number) + ",\"iteration\":" + std::to_string(each.iteration) + ",\"time_ns\":" + std::to_string(each.time_ns);
                changes += ",\"component\":" + json_text(each.component) + ",\"source\":" + json_text(each.source) + ",\"target\":" + json_text(each.target) + ",\"transition\":" + or_null(each.transition) + "}";
            }
        }
        viewer.seen_change = changes_.empty() ? viewer.seen_change : changes_.back().number;
        const std::int64_t missed = viewer.seen_number == 0 ? 0 : std::max<std::int64_t>(0, head.iteration - viewer.seen_iteration - 1);
        viewer.seen_number = head.number;
        viewer.seen_iteration = head.iteration;
        viewer.due_s = now + (is_shown ? viewer.period_s : std::max(0.5, viewer.period_s));
        viewer.unsent += text + ",\"changes\":[" + changes + "],\"missed\":" + std::to_string(missed) + "}\n";
        write(viewer);
    }

    void send(Viewer& viewer, const std::string& text) {
        viewer.is_lost = viewer.is_lost || viewer.unsent.size() > most_unsent_;
        if (!viewer.is_lost) {
            viewer.unsent += text;
            write(viewer);
        }
    }
    void write(Viewer& viewer) {
        if (!viewer.unsent.empty()) {
            const std::ptrdiff_t sent = send_some(viewer.socket, viewer.unsent);
            viewer.is_lost = viewer.is_lost || (sent < 0 && !would_block());
            viewer.unsent.erase(0, sent > 0 ? static_cast<std::size_t>(sent) : 0);
        }
    }

    /// Closes lost connections; what their viewers hold ends.
    void drop_lost() {
        for (Viewer& viewer : viewers_) {
            if (viewer.is_lost) {
                close_socket(viewer.socket);
                if (viewer.has_control) {
                    auto request = std::make_unique<Request>();
                    request->apply = [](Robot& robot, Request& given) { robot.release(given); };
                    request->viewer = viewer.id;
                    waiting_.push_back(std::move(request));
                }
            }
        }
        viewers_.erase(std::remove_if(viewers_.begin(), viewers_.end(), [](const Viewer& each) { return each.is_lost; }), viewers_.end());
    }

    Robot& robot_;
    std::string name_;
    std::string token_;
    std::string address_;
    std::string path_;
    std::string problem_;
    Socket listener_ = no_socket;
    std::vector<Viewer> viewers_;
    std::uint64_t last_id_ = 0;
    Allowance connections_{30.0, 64.0};
    double accept_s_ = 0.0;
    std::deque<std::unique_ptr<Request>> waiting_;
    std::size_t handed_over_ = 0;
    const Iteration* newest_ = nullptr;
    std::string with_values_;
    std::string without_values_;
    std::deque<Change> changes_;
    std::atomic<bool> is_closing_{false};
    std::thread thread_;
};

}  // namespace live

/// Lets viewers connect to a robot and records it, as its options say. Make it after the components and before the first
/// iteration; the root, the components and other observers must outlive it.
class Live {
public:
    Live(Root& root, const Component& main, LiveProject project, const LiveOptions& options = LiveOptions()) : robot_(root, main, std::move(project), options), server_(robot_) {
        if (options.watch.empty()) {
            return;
        }
        if (options.control && !options.hold && !options.without_hold) {
            problem_ = "cannot be controlled, so it is not watched: a paused robot would keep moving; set LiveOptions::hold, or use --without-hold or VICODE_WATCH_CONTROL=without-hold";
        } else {
            problem_ = server_.open(options.watch);
        }
        if (!problem_.empty()) {
            live::print_line("error", problem_);
        }
    }

    /// Why nobody can connect although that was asked for; empty if they can.
    const std::string& problem() const { return problem_; }

private:
    live::Robot robot_;
    live::Server server_;
    std::string problem_;
};

BICA_CLOSE
}  // namespace bica
