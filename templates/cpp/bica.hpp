/// The runtime of components that vicode generates in C++17. It needs the standard library only, and neither
/// exceptions nor run-time type information; nothing allocates memory after construction, except traces.
///
/// The semantics are those of docs/semantics.md in vicode.
#pragma once

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

// BICA_NO_HOST leaves out clocks, threads and files; BICA_NO_NAMES the names of components, states and values, with teams,
// observers and traces; BICA_FLOAT calculates with 32 bits.
#if !defined(BICA_NO_HOST) && !defined(ARDUINO)
#define BICA_HOST 1
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>
#endif

#if defined(__cpp_exceptions)
#include <exception>
#endif

#if defined(ARDUINO)  // macros of Arduino.h
#undef abs
#undef degrees
#undef max
#undef min
#undef radians
#undef round
#endif

#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define BICA_INLINE inline __attribute__((always_inline))
#define BICA_INLINE_LAMBDA __attribute__((always_inline))
#else
#define BICA_INLINE inline
#define BICA_INLINE_LAMBDA
#endif

#if defined(__GNUC__)
#define BICA_NO_INLINE __attribute__((noinline))
#define BICA_DROP_NAME inline __attribute__((always_inline))
#define BICA_UNLIKELY(condition) __builtin_expect(condition, false)
#else
#define BICA_NO_INLINE
#define BICA_DROP_NAME
#define BICA_UNLIKELY(condition) (condition)
#endif

#if !defined(BICA_ALLOW_INEXACT)
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error "With -ffast-math, states differ from those of the design: compile without it, or define BICA_ALLOW_INEXACT."
#elif FLT_EVAL_METHOD != 0
#error "Numbers are calculated with more digits than those of the design: compile with -msse2 -mfpmath=sse, or define BICA_ALLOW_INEXACT."
#endif
#endif

// Files that are compiled with other macros or without exceptions have other names, so that they do not link with these.
#if defined(BICA_HOST)
#define BICA_HOST_TAG
#else
#define BICA_HOST_TAG _no_host
#endif
#if defined(BICA_NO_NAMES)
#define BICA_NAMES_TAG _no_names
#define BICA_NAMED
#else
#define BICA_NAMES_TAG
#define BICA_NAMED override
#endif
#if defined(BICA_FLOAT)
#define BICA_FLOAT_TAG _float
#else
#define BICA_FLOAT_TAG
#endif
// With BICA_LIVE, tunable constants are variables that viewers of a robot may change.
#if defined(BICA_LIVE)
#define BICA_LIVE_TAG _live
#define BICA_TUNABLE inline
#define BICA_FROM_TUNABLE inline const
#else
#define BICA_LIVE_TAG
#define BICA_TUNABLE inline constexpr
#define BICA_FROM_TUNABLE inline constexpr
#endif
#if defined(__cpp_exceptions)
#define BICA_EXCEPTIONS_TAG
#else
#define BICA_EXCEPTIONS_TAG _no_exceptions
#endif
#if defined(BICA_HOST) && !defined(BICA_NO_NAMES) && !defined(BICA_FLOAT) && !defined(BICA_LIVE) && defined(__cpp_exceptions)
#define BICA_OPEN
#define BICA_CLOSE
#else
#define BICA_JOIN(host, names, numbers, live, exceptions) built##host##names##numbers##live##exceptions
#define BICA_CONFIGURATION(host, names, numbers, live, exceptions) BICA_JOIN(host, names, numbers, live, exceptions)
#define BICA_OPEN \
    inline namespace BICA_CONFIGURATION(BICA_HOST_TAG, BICA_NAMES_TAG, BICA_FLOAT_TAG, BICA_LIVE_TAG, BICA_EXCEPTIONS_TAG) {
#define BICA_CLOSE }
#endif

// Generated code stands between BICA_BEGIN and BICA_END, where no multiplication is fused with an addition, which would
// give another result. g++ inlines functions with this option only into others with it; BICA_EXACT marks such a function.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#define BICA_BEGIN BICA_OPEN
#define BICA_END BICA_CLOSE
#define BICA_EXACT
#elif defined(__GNUC__)
#define BICA_BEGIN _Pragma("GCC push_options") _Pragma("GCC optimize(\"fp-contract=off\")") BICA_OPEN
#define BICA_END \
    BICA_CLOSE   \
    _Pragma("GCC pop_options")
#define BICA_EXACT __attribute__((optimize("fp-contract=off")))
#else
#define BICA_BEGIN BICA_OPEN
#define BICA_END BICA_CLOSE
#define BICA_EXACT
#endif

namespace bica {
BICA_OPEN

using Nanoseconds = std::int64_t;

// Arithmetic: the results that docs/semantics.md defines, the same in all generated languages

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

#if defined(BICA_FLOAT)

/// A number of a design with 32 bits. Numbers of C++ convert to it; `static_cast` converts it to them.
class Real {
public:
    constexpr Real() = default;
    template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
    constexpr Real(Number x) : value_(static_cast<float>(x)) {}
    template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
    explicit constexpr operator Number() const {
        return static_cast<Number>(value_);
    }

    constexpr Real operator-() const { return -value_; }
    constexpr Real& operator+=(Real x) { return *this = *this + x; }
    constexpr Real& operator-=(Real x) { return *this = *this - x; }
    constexpr Real& operator*=(Real x) { return *this = *this * x; }
    constexpr Real& operator/=(Real x) { return *this = *this / x; }
    friend constexpr Real operator+(Real a, Real b) { return a.value_ + b.value_; }
    friend constexpr Real operator-(Real a, Real b) { return a.value_ - b.value_; }
    friend constexpr Real operator*(Real a, Real b) { return a.value_ * b.value_; }
    friend constexpr Real operator/(Real a, Real b) { return a.value_ / b.value_; }
    friend constexpr bool operator==(Real a, Real b) { return a.value_ == b.value_; }
    friend constexpr bool operator!=(Real a, Real b) { return a.value_ != b.value_; }
    friend constexpr bool operator<(Real a, Real b) { return a.value_ < b.value_; }
    friend constexpr bool operator<=(Real a, Real b) { return a.value_ <= b.value_; }
    friend constexpr bool operator>(Real a, Real b) { return a.value_ > b.value_; }
    friend constexpr bool operator>=(Real a, Real b) { return a.value_ >= b.value_; }

private:
    float value_ = 0.0F;
};

#else

/// A number of a design.
using Real = double;

#endif

/// Converts an integer, exact to ±2^53 (`BICA_FLOAT`: ±2^24), else the nearest number.
constexpr Real to_float(std::int64_t x) { return static_cast<Real>(x); }
constexpr Real to_float(int x) { return static_cast<Real>(x); }
constexpr Real to_float(Real x) { return x; }

/// IEEE division: a division by 0 gives an infinity or nan.
inline double divide(double a, double b) {
#if defined(__clang__) || defined(__GNUC__)
    if (b == 0.0) {  // defined by IEEE, but the sanitizers of undefined behavior report it
        return a == 0.0 || std::isnan(a) ? nan : std::copysign(std::numeric_limits<double>::infinity(), a) * std::copysign(1.0, b);
    }
#endif
    return a / b;
}

/// The remainder with the sign of `b`; nan if `b` is 0.
inline double modulo(double a, double b) {
    if (b == 0.0) {
        return nan;
    }
    double rest = std::fmod(a, b);
    if (rest == 0.0) {
        return std::copysign(0.0, b);
    }
    return (b < 0.0) != (rest < 0.0) ? rest + b : rest;
}

/// The quotient, rounded towards minus infinity; a division by 0 as in `divide`.
inline double floor_divide(double a, double b) {
    if (b == 0.0) {
        return divide(a, b);
    }
    double rest = std::fmod(a, b);
    double quotient = (a - rest) / b;
    if (rest != 0.0 && (b < 0.0) != (rest < 0.0)) {
        quotient -= 1.0;
    }
    if (quotient == 0.0) {
        return std::copysign(0.0, a / b);
    }
    const double floored = std::floor(quotient);
    return quotient - floored > 0.5 ? floored + 1.0 : floored;
}

/// Division as in the XABSL engine: by 0.0000001 instead of 0.
constexpr double xabsl_divide(double a, double b) { return a / (b == 0.0 ? 1e-7 : b); }

/// Remainder of the integer parts as in the XABSL engine: the sign of `a`, and 0 if the integer part of `b` is 0.
/// An integer has no -0.0.
inline double xabsl_remainder(double a, double b) {
    const double divisor = std::trunc(b);
    return std::isfinite(a) && std::isfinite(b) && divisor != 0.0 ? std::fmod(std::trunc(a) + 0.0, divisor) : 0.0;
}

/// The greatest int that is stored, 2^53: a double represents it and all smaller ones exactly.
inline constexpr std::int64_t max_int = 9007199254740992;

/// An int that is stored: limited to ±2^53.
constexpr std::int64_t limit(std::int64_t x) { return x > max_int ? max_int : (x < -max_int ? -max_int : x); }

// Operations whose results are limited to 64 bits
constexpr std::int64_t add(std::int64_t a, std::int64_t b) {
    constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    if (b > 0 ? a > most - b : a < least - b) {
        return b > 0 ? most : least;
    }
    return a + b;
}

constexpr std::int64_t subtract(std::int64_t a, std::int64_t b) {
    constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    if (b > 0 ? a < least + b : a > most + b) {
        return b > 0 ? least : most;
    }
    return a - b;
}

constexpr std::int64_t negate(std::int64_t x) { return subtract(0, x); }

constexpr std::int64_t multiply(std::int64_t a, std::int64_t b) {
    constexpr std::int64_t half = 0x7fffffff;
    if (-half <= a && a <= half && -half <= b && b <= half) {
        return a * b;
    }
    if (a == 0 || b == 0) {
        return 0;
    }
    const bool is_negative = (a < 0) != (b < 0);
    const std::uint64_t x = a < 0 ? 0 - static_cast<std::uint64_t>(a) : static_cast<std::uint64_t>(a);
    const std::uint64_t y = b < 0 ? 0 - static_cast<std::uint64_t>(b) : static_cast<std::uint64_t>(b);
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    if (x > (static_cast<std::uint64_t>(most) + (is_negative ? 1 : 0)) / y) {
        return is_negative ? std::numeric_limits<std::int64_t>::min() : most;
    }
    // One less, since the magnitude of the least integer is no int64_t.
    return is_negative ? -static_cast<std::int64_t>(x * y - 1) - 1 : static_cast<std::int64_t>(x * y);
}

/// Converts an integral double, limited to 64 bits; nan gives 0.
inline std::int64_t saturate(double x) {
    if (std::isnan(x)) {
        return 0;
    }
    if (x >= 9223372036854775808.0) {
        return std::numeric_limits<std::int64_t>::max();
    }
    return x > -9223372036854775808.0 ? static_cast<std::int64_t>(x) : std::numeric_limits<std::int64_t>::min();
}

/// The nearest integer; halves to the even one.
inline double nearest(double x) {
    const double below = std::floor(x);
    const double rest = x - below;
    const bool is_up = rest > 0.5 || (rest == 0.5 && std::fmod(below, 2.0) != 0.0);
    return is_up ? below + 1.0 : below;
}

inline std::int64_t to_int(double x) { return limit(saturate(x)); }
inline std::int64_t floor(double x) { return limit(saturate(std::floor(x))); }
inline std::int64_t ceil(double x) { return limit(saturate(std::ceil(x))); }
inline std::int64_t round(double x) { return limit(saturate(nearest(x))); }

/// A time, rounded to whole nanoseconds and limited to 64 bits; nan never ends.
inline Nanoseconds nanoseconds(double x) {
    return std::isnan(x) ? std::numeric_limits<Nanoseconds>::max() : saturate(nearest(x));
}

template <class Number>
constexpr Number abs(Number x) {
    if constexpr (std::is_integral_v<Number>) {
        return x < 0 ? negate(x) : x;
    } else {
        return x < 0 || x == 0 ? 0 - x : x;
    }
}

template <class Number>
constexpr Number min(Number a, Number b) {
    return b < a ? b : a;
}
template <class Number, class... More>
constexpr Number min(Number a, Number b, More... more) {
    return min(min(a, b), more...);
}

template <class Number>
constexpr Number max(Number a, Number b) {
    return b > a ? b : a;
}
template <class Number, class... More>
constexpr Number max(Number a, Number b, More... more) {
    return max(max(a, b), more...);
}

template <class Number>
constexpr Number clamp(Number x, Number low, Number high) {
    return x < low ? low : (high < x ? high : x);
}

template <class Number>
constexpr std::int64_t sign(Number x) {
    return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0);
}

inline double sqrt(double x) { return std::sqrt(x); }
inline double exp(double x) { return std::exp(x); }
inline double log(double x) { return x == 0.0 ? -std::numeric_limits<double>::infinity() : std::log(x); }
inline double sin(double x) { return std::sin(x); }
inline double cos(double x) { return std::cos(x); }
inline double tan(double x) { return std::tan(x); }
inline double asin(double x) { return std::asin(x); }
inline double acos(double x) { return std::acos(x); }
inline double atan(double x) { return std::atan(x); }
inline double atan2(double y, double x) { return std::atan2(y, x); }
BICA_EXACT inline double hypot(double x, double y) { return std::sqrt(x * x + y * y); }
constexpr double degrees(double x) { return x * (180.0 / pi); }
constexpr double radians(double x) { return x * (pi / 180.0); }
inline bool is_nan(double x) { return std::isnan(x); }

#if defined(BICA_FLOAT)
inline Real divide(Real a, Real b) { return b == 0.0 ? Real(divide(static_cast<double>(a), static_cast<double>(b))) : a / b; }
inline Real modulo(Real a, Real b) { return modulo(static_cast<double>(a), static_cast<double>(b)); }
inline Real floor_divide(Real a, Real b) { return floor_divide(static_cast<double>(a), static_cast<double>(b)); }
constexpr Real xabsl_divide(Real a, Real b) { return a / (b == 0.0 ? Real(1e-7) : b); }
inline Real xabsl_remainder(Real a, Real b) { return xabsl_remainder(static_cast<double>(a), static_cast<double>(b)); }
inline std::int64_t to_int(Real x) { return to_int(static_cast<double>(x)); }
inline std::int64_t floor(Real x) { return floor(static_cast<double>(x)); }
inline std::int64_t ceil(Real x) { return ceil(static_cast<double>(x)); }
inline std::int64_t round(Real x) { return round(static_cast<double>(x)); }
inline Nanoseconds nanoseconds(Real x) { return nanoseconds(static_cast<double>(x)); }
constexpr Real abs(Real x) { return x < 0.0 || x == 0.0 ? 0.0 - x : x; }
constexpr Real min(Real a, Real b) { return b < a ? b : a; }
template <class... More>
constexpr Real min(Real a, Real b, Real c, More... more) {
    return min(min(a, b), c, more...);
}
constexpr Real max(Real a, Real b) { return b > a ? b : a; }
template <class... More>
constexpr Real max(Real a, Real b, Real c, More... more) {
    return max(max(a, b), c, more...);
}
constexpr Real clamp(Real x, Real low, Real high) { return clamp<Real>(x, low, high); }
inline Real sqrt(Real x) { return std::sqrt(static_cast<float>(x)); }
inline Real exp(Real x) { return std::exp(static_cast<float>(x)); }
inline Real log(Real x) { return x == 0.0 ? -std::numeric_limits<float>::infinity() : std::log(static_cast<float>(x)); }
inline Real sin(Real x) { return std::sin(static_cast<float>(x)); }
inline Real cos(Real x) { return std::cos(static_cast<float>(x)); }
inline Real tan(Real x) { return std::tan(static_cast<float>(x)); }
inline Real asin(Real x) { return std::asin(static_cast<float>(x)); }
inline Real acos(Real x) { return std::acos(static_cast<float>(x)); }
inline Real atan(Real x) { return std::atan(static_cast<float>(x)); }
inline Real atan2(Real y, Real x) { return std::atan2(static_cast<float>(y), static_cast<float>(x)); }
BICA_EXACT inline Real hypot(Real x, Real y) { return sqrt(x * x + y * y); }
constexpr Real degrees(Real x) { return x * (180.0 / pi); }
constexpr Real radians(Real x) { return x * (pi / 180.0); }
inline bool is_nan(Real x) { return x != x; }
#endif

class Component;

// Teams

/// A state that robots of a team enter together, or that a limited number of them may be in.
struct StateKey {
    const char* component;
    const char* state;
};

#if defined(BICA_NO_NAMES)

struct NoTeam {};

/// Robots of a team tell each other the names of their states.
class CooperativeState {
public:
    template <class Names = void>
    CooperativeState(NoTeam, const Component&, StateKey, std::int64_t, bool) {
        static_assert(!std::is_void_v<Names>, "states with capacity or synchronized need names: compile without BICA_NO_NAMES");
    }
    bool may_enter() { return true; }
    bool is_full() const { return false; }
};

#else

inline bool operator==(const StateKey& a, const StateKey& b) {
    return std::strcmp(a.component, b.component) == 0 && std::strcmp(a.state, b.state) == 0;
}

/// What a robot tells its team after an iteration; the robot program sends it. At most `capacity` states of each kind.
struct TeamMessage {
    static constexpr std::size_t capacity = 32;

    struct States {
        std::array<StateKey, capacity> keys{};
        std::size_t size = 0;

        void add(const StateKey& key) {
            if (size < capacity) {
                keys[size++] = key;
            }
        }
        const StateKey* begin() const { return keys.data(); }
        const StateKey* end() const { return keys.data() + size; }
    };

    std::int64_t priority = 0;
    States executed;
    States entering;
    States near;
};

class Team;

/// A cooperative state of this robot, and what the other robots do there.
class CooperativeState {
public:
    CooperativeState(Team& team, const Component& component, StateKey key, std::int64_t number, bool is_capacity);
    CooperativeState(const CooperativeState&) = delete;
    CooperativeState& operator=(const CooperativeState&) = delete;
    /// Leaves the team, which may outlive the components.
    ~CooperativeState();

    /// Whether this robot may enter the state now; if not, the team is told that it waits, unless it yields.
    bool may_enter();
    /// Whether other robots fill the capacity.
    bool is_full() const { return is_capacity_ && executing_ >= number_; }

private:
    friend class Team;

    bool can_enter_within_capacity();
    bool can_enter_together();
    void reset();

    Team* team_;
    const Component& component_;
    StateKey key_;
    std::int64_t number_;
    bool is_capacity_;
    bool is_entering_ = false;
    std::int64_t executing_ = 0;
    std::int64_t others_entering_ = 0;
    std::int64_t in_component_ = 0;
    std::int64_t highest_priority_ = 0;
    std::int64_t waiting_iterations_ = 0;
    CooperativeState* next_ = nullptr;
};

/// The cooperative states of this robot.
class Team {
public:
    Team() = default;
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;
#if defined(BICA_HOST)
    /// The components may outlive the team. On a controller, both live as long as the program.
    ~Team();
#endif

    std::int64_t priority = 0;
    /// The number of iterations until the team answers a message.
    std::int64_t ticks = 0;
    /// The number of robots that are alive, with this one: those whose messages were heard for this iteration.
    std::int64_t size = 1;

    /// Clears the messages of the last iteration; call it before `hear`. If it is never called, the robot is alone.
    void prepare();
    /// Takes the message of another robot; unknown states are ignored.
    void hear(const TeamMessage& message);
    /// The message to the other robots; call it after each iteration.
    TeamMessage tell() const;

private:
    friend class CooperativeState;
    friend class Root;

    void begin_iteration() {
        if (is_alone_) {
            clear();
        }
    }
    void clear();
    CooperativeState* find(const StateKey& key);

    CooperativeState* first_ = nullptr;
    CooperativeState* last_ = nullptr;
    bool is_alone_ = true;
};

#endif

// Components

/// Receives the values of a component, or its parameters.
class ValueVisitor {
public:
    virtual void visit(const char* name, bool value) = 0;
    virtual void visit(const char* name, std::int64_t value) = 0;
    virtual void visit(const char* name, double value) = 0;
    /// An element of an enumeration.
    virtual void visit(const char* name, const char* enumeration, const char* element) = 0;
#if defined(BICA_FLOAT)
    void visit(const char* name, Real value) { visit(name, static_cast<double>(value)); }
#endif

protected:
    // No object is deleted through a base class: a virtual destructor would need the heap of a controller.
    ~ValueVisitor() = default;
};

#if !defined(BICA_NO_NAMES)

/// Watches the steps of all components of a root.
class Observer {
public:
    virtual void begin_step(const Component& component, bool is_modulated, bool works) = 0;
    virtual void end_step(const Component& component) = 0;
    virtual void error(const Component& component, const char* what) = 0;
    /// Called after `begin_step`; the component does not run its step if this returns true.
    virtual bool replaces_step(Component&) { return false; }

protected:
    ~Observer() = default;
};

#endif

/// The top of an activation tree: time, iteration, team, and what observes them.
class Root {
public:
    Root() = default;
    Root(const Root&) = delete;
    Root& operator=(const Root&) = delete;

    /// Runs one iteration of the root component. If the clock was set back, time continues from the last iteration.
    template <class Main>
    void step(Main& main, Nanoseconds clock_ns) {
        Nanoseconds now = clock_ns + lag_ns_;
        if (now < now_ns_) {
            lag_ns_ += now_ns_ - now;
            now = now_ns_;
        }
        now_ns_ = now;
        ++iteration_;
#if !defined(BICA_NO_NAMES)
        team.begin_iteration();
#endif
        main.step();
    }

    Nanoseconds now_ns() const { return now_ns_; }
    std::int64_t iteration() const { return iteration_; }

    /// Leaves out a time that passed on the clock, such as a pause.
    void skip_time(Nanoseconds time_ns) { lag_ns_ -= time_ns; }

    /// Counts an error; without a handler or observer it is printed once per component.
    void report(Component& component, const char* what);

#if defined(BICA_NO_NAMES)
    static constexpr NoTeam team{};
#else
    Team team;
    Observer* observer = nullptr;
#endif
    /// Called with each error, instead of printing it.
    void (*on_error)(const Component& component, const char* what) = nullptr;

private:
    friend class Component;

    Nanoseconds now_ns_ = 0;
    Nanoseconds lag_ns_ = 0;
    std::int64_t iteration_ = 0;
#if !defined(BICA_NO_NAMES)
    const Component* modulated_ = nullptr;
#endif
};

/// The parameters of a component without any.
struct NoParameters {};

/// A unit of functionality that works iteratively while other components step it.
///
/// A component written by hand implements `work`, and overrides `restart` if needed.
class Component {
public:
#if defined(BICA_NO_NAMES)
    BICA_DROP_NAME Component(Root& root_, const char*, double frequency_hz = 0.0) : root(root_), period_ns_(period(frequency_hz)) {}
#else
    Component(Root& root_, const char* name, double frequency_hz = 0.0) : root(root_), period_ns_(period(frequency_hz)), name_(name) {}
#endif
    Component(const Component&) = delete;
    Component& operator=(const Component&) = delete;

    /// Activates the component: restarts it if it was inactive, then works if its period has elapsed.
    virtual void step() {
        if (!begin_observed_step()) {
            return;
        }
        attempt(*this, [this] {
            if (count_step(false)) {
                restart_times();
                restart();
            }
            if (must_work()) {
                work();
            }
        });
        end_observed_step();
    }

#if !defined(BICA_NO_NAMES)
    const char* name() const { return name_; }
    virtual const char* state_name() const { return ""; }
    virtual void visit_values(ValueVisitor&) const {}
    /// The values that the component provides without work; those of a component of the world are read from it.
    virtual void visit_inputs(ValueVisitor& visitor) const { visit_values(visitor); }
    virtual void visit_parameters(ValueVisitor&) const {}
#endif

    using Parameters = NoParameters;
    void modulate(const NoParameters&) {}

    /// Works at another frequency from now on; 0 means in each iteration. A generated component must have a frequency.
    void set_frequency(double hertz) { period_ns_ = period(hertz); }

    Real state_time() const { return to_float(state_time_ns()) / 1e9; }
    Real component_time() const { return to_float(component_time_ns()) / 1e9; }
    Nanoseconds state_time_ns() const { return root.now_ns_ - entered_ns_; }
    Nanoseconds component_time_ns() const { return root.now_ns_ - started_ns_; }

    /// Whether the component was in a final state after its last step, in this or the previous iteration.
    bool is_done() const { return in_final_state() && is_recent(); }
    bool was_stepped() const { return stepped_in_ == root.iteration_; }
    /// The number of the iteration that stepped it last; negative before.
    std::int64_t stepped_in() const { return stepped_in_; }
#if !defined(BICA_NO_NAMES)
    /// The state that the last step left, for observers; nullptr if it left none.
    const char* left_state() const { return left_; }
    /// The id of the transition that the last step took, for observers; nullptr if it has none.
    const char* transition() const { return transition_; }
#endif

#if !defined(BICA_NO_NAMES)
    // What the live view needs of a generated component; instantiated only there.

    /// Leaves the active state and enters another one between two iterations.
    template <class Machine>
    static void enter_state(Machine& machine, typename Machine::State next) {
        machine.leave();
        machine.state_ = next;
        machine.entered_ns_ = machine.root.now_ns_;
        machine.forget_calls();
        machine.enter();
    }
    template <class Machine>
    static bool action_done_of(const Machine& machine) {
        return machine.action_done();
    }
    template <class Machine>
    static bool conflict_of(const Machine& machine) {
        return machine.conflict();
    }
#endif

    Root& root;
    /// Number of reported errors.
    std::int64_t errors = 0;

protected:
    ~Component() = default;

    virtual void work() {}
    virtual void restart() {}
    virtual bool in_final_state() const { return false; }
    virtual bool is_recent() const { return root.iteration_ - stepped_in_ <= 1; }

    /// Runs one step of a generated component.
    template <class Machine>
    BICA_INLINE static void step_machine(Machine& machine, bool resume) {
#if !defined(BICA_NO_NAMES)
        if (BICA_UNLIKELY(machine.root.observer != nullptr)) {
            step_observed(machine, resume);
            return;
        }
#endif
        run_step(machine, resume);
    }

#if !defined(BICA_NO_NAMES)
    template <class Machine>
    BICA_EXACT BICA_NO_INLINE static void step_observed(Machine& machine, bool resume) {
        if (machine.begin_observed_step(resume)) {
            run_step(machine, resume);
            machine.end_observed_step();
        }
    }
#endif

    /// The same for a component with many states: its decisions and actions exist once, observed or not.
    template <class Machine>
    BICA_INLINE static void step_large_machine(Machine& machine, bool resume) {
#if !defined(BICA_NO_NAMES)
        if (BICA_UNLIKELY(machine.root.observer != nullptr) && !machine.begin_observed_step(resume)) {
            return;
        }
#endif
        run_step(machine, resume);
#if !defined(BICA_NO_NAMES)
        if (BICA_UNLIKELY(machine.root.observer != nullptr)) {
            machine.end_observed_step();
        }
#endif
    }

    /// Modulates and steps a component.
    template <class Target>
    void call(Target& target, const typename Target::Parameters& parameters) {
        target.modulate(parameters);
        step_modulated(target);
    }

    /// Calls a component, and stores the call until the next work if this component has a frequency.
    template <class Target, class Stored>
    void call(Target& target, const typename Target::Parameters& parameters, Stored& calls) {
        target.modulate(parameters);
        if (period_ns_ != 0) {
            calls.add(target, parameters);
        }
        step_modulated(target);
    }

    template <class Target>
    void step_modulated(Target& target) {
#if !defined(BICA_NO_NAMES)
        root.modulated_ = &target;
#endif
        target.step();
    }

    /// Starts the time of the new state; tells observers which one was left.
    BICA_INLINE void change_state([[maybe_unused]] const char* transition) {
#if !defined(BICA_NO_NAMES)
        if (BICA_UNLIKELY(root.observer != nullptr)) {
            record_change(transition);
        }
#endif
        entered_ns_ = root.now_ns_;
    }

    // What a generated component without these parts uses.
    void require(std::uint64_t) {}
    void forget_calls() {}
    void repeat_calls() {}
    void enter() {}
    void leave() {}

    Nanoseconds period_ns() const { return period_ns_; }
    Nanoseconds entered_ns() const { return entered_ns_; }

    /// Whether the component was inactive before this step, and does not resume.
    bool is_restarting(bool resume) const {
        const std::int64_t missed = root.iteration_ - stepped_in_;
        return missed > 1 && (!resume || stepped_in_ == never_);
    }

    /// Remembers that the component is stepped; returns whether it restarts.
    bool count_step(bool resume) {
        const bool restarts = is_restarting(resume);
        stepped_in_ = root.iteration_;
        return restarts;
    }

    void restart_times() {
        started_ns_ = entered_ns_ = root.now_ns_;
        worked_ns_ = root.now_ns_ - period_ns_;
    }

    // An XabslComponent sets it two iterations back, which may be -1.
    static constexpr std::int64_t never_ = -2;
    std::int64_t stepped_in_ = never_;

private:
    friend class Root;

#if !defined(BICA_NO_NAMES)
    BICA_NO_INLINE void record_change(const char* transition) {
        left_ = state_name();
        transition_ = transition;
    }
#endif

    static Nanoseconds period(double hertz) { return hertz == 0.0 ? 0 : nanoseconds(1e9 / hertz); }

    BICA_INLINE bool must_work() {
        if (root.now_ns_ - worked_ns_ < period_ns_) {
            return false;
        }
        worked_ns_ = root.now_ns_;
        return true;
    }

    template <class Machine>
    BICA_INLINE static void run_step(Machine& machine, bool resume) {
        const bool restarts = machine.count_step(resume);
        attempt(machine, [&machine, restarts]() BICA_INLINE_LAMBDA {
            if (BICA_UNLIKELY(restarts)) {
                restart_machine(machine);
            }
            machine.require(0);
            if (machine.must_work()) {
                machine.forget_calls();
                machine.decide();
                machine.act();
            } else {
                machine.repeat_calls();
            }
        });
    }

    /// A separate function, because compilers store both times at once, and then read the time of the root in a slow way.
    template <class Machine>
    BICA_EXACT BICA_NO_INLINE static void restart_machine(Machine& machine) {
        machine.restart_times();
        machine.start();
    }

#if defined(BICA_NO_NAMES)
    bool begin_observed_step() { return true; }
    void end_observed_step() {}
#else
    bool will_work(bool resume) const {
        return is_restarting(resume) || root.now_ns_ - worked_ns_ >= period_ns_;
    }

    /// Returns whether the step runs.
    bool begin_observed_step(bool resume = false) {
        if (root.observer == nullptr) {
            return true;
        }
        const bool is_modulated = root.modulated_ == this;
        root.modulated_ = nullptr;
        left_ = transition_ = nullptr;
        root.observer->begin_step(*this, is_modulated, will_work(resume));
        if (!root.observer->replaces_step(*this)) {
            return true;
        }
        count_step(false);
        end_observed_step();
        return false;
    }

    void end_observed_step() {
        if (root.observer != nullptr) {
            root.observer->end_step(*this);
        }
    }
#endif

    template <class Body>
    BICA_INLINE static void attempt(Component& component, Body body) {
#if defined(__cpp_exceptions)
        try {
            body();
        } catch (const std::exception& error) {
            component.root.report(component, error.what());
        } catch (...) {
            component.root.report(component, "unknown exception");
        }
#else
        static_cast<void>(component);
        body();
#endif
    }

    Nanoseconds period_ns_;
    Nanoseconds started_ns_ = 0;
    Nanoseconds entered_ns_ = 0;
    Nanoseconds worked_ns_ = 0;
#if !defined(BICA_NO_NAMES)
    const char* name_;
    const char* left_ = nullptr;
    const char* transition_ = nullptr;
#endif
};

/// The calls of the last work of a component with a frequency; they are repeated until it works again.
template <std::size_t Count, std::size_t Size>
class Calls {
public:
    template <class Target>
    void add(Target& target, const typename Target::Parameters& parameters) {
        using Parameters = typename Target::Parameters;
        static_assert(std::is_trivially_copyable_v<Parameters> && sizeof(Parameters) <= Size);
        if (size_ == Count) {
            return;  // not reached: Count is the number of calls in the design
        }
        Call& call = calls_[size_++];
        call.target = &target;
        std::memcpy(call.parameters.data(), &parameters, sizeof(Parameters));
        call.modulate = [](Component& component, const unsigned char* bytes) {
            Parameters copy;
            std::memcpy(&copy, bytes, sizeof(Parameters));
            static_cast<Target&>(component).modulate(copy);
        };
    }

    void clear() { size_ = 0; }

    /// Sets the parameters again, since another component may have set them, and steps.
    template <class Step>
    void repeat(Step step) {
        for (std::size_t index = 0; index < size_; ++index) {
            Call& call = calls_[index];
            call.modulate(*call.target, call.parameters.data());
            step(*call.target);
        }
    }

private:
    struct Call {
        Component* target = nullptr;
        void (*modulate)(Component&, const unsigned char*) = nullptr;
        std::array<unsigned char, Size> parameters{};
    };

    std::array<Call, Count> calls_{};
    std::size_t size_ = 0;
};

/// The calls of up to `Count` components.
template <std::size_t Count, class... Targets>
using CallsOf = Calls<Count, max(std::size_t{1}, sizeof(typename Targets::Parameters)...)>;

/// A component with the semantics of the XABSL engine (`arithmetic: xabsl`).
class XabslComponent : public Component {
public:
    using Component::Component;

protected:
    ~XabslComponent() = default;

    /// A component that was inactive in the last iteration is restarted by each step of this one.
    void restart_again() {
        if (stepped_in_ == root.iteration() && restarted_in_ == root.iteration()) {
            stepped_in_ = root.iteration() - 2;
        }
    }
    void mark_restart() { restarted_in_ = root.iteration(); }
    bool is_recent() const override {
        const bool is_current = stepped_in_ == root.iteration();
        return is_current ? restarted_in_ != root.iteration() : stepped_in_ == root.iteration() - 1;
    }

private:
    std::int64_t restarted_in_ = -1;
};

inline void Root::report(Component& component, const char* what) {
    ++component.errors;
#if !defined(BICA_NO_NAMES)
    if (observer != nullptr) {
        observer->error(component, what);
    }
#endif
    if (on_error != nullptr) {
        on_error(component, what);
    }
#if defined(BICA_HOST)
    else if (component.errors == 1) {
#if defined(BICA_NO_NAMES)
        std::fprintf(stderr, "a component: %s (reported once)\n", what);
#else
        std::fprintf(stderr, "%s, state '%s': %s (reported once)\n", component.name(), component.state_name(), what);
#endif
    }
#endif
}

#if !defined(BICA_NO_NAMES)

inline CooperativeState::CooperativeState(Team& team, const Component& component, StateKey key, std::int64_t number, bool is_capacity)
    : team_(&team), component_(component), key_(key), number_(number), is_capacity_(is_capacity) {
    (team.last_ != nullptr ? team.last_->next_ : team.first_) = this;
    team.last_ = this;
}

inline CooperativeState::~CooperativeState() {
    if (team_ == nullptr) {
        return;
    }
    CooperativeState* before = nullptr;
    for (CooperativeState* state = team_->first_; state != this; state = state->next_) {
        before = state;
    }
    (before != nullptr ? before->next_ : team_->first_) = next_;
    team_->last_ = team_->last_ == this ? before : team_->last_;
}

inline bool CooperativeState::may_enter() { return is_capacity_ ? can_enter_within_capacity() : can_enter_together(); }

inline bool CooperativeState::can_enter_within_capacity() {
    const bool is_contested = executing_ + others_entering_ >= number_;
    if (is_contested && !is_full() && highest_priority_ == team_->priority) {
        return false;  // robots with equal priority yield to each other
    }
    const bool is_free = !is_full() && !(is_contested && highest_priority_ > team_->priority);
    if (is_free && waiting_iterations_ >= team_->ticks) {
        return true;
    }
    is_entering_ = true;
    return false;
}

inline bool CooperativeState::can_enter_together() {
    is_entering_ = true;
    const bool has_enough_robots = in_component_ + 1 >= number_;
    const bool is_team_ready = executing_ + others_entering_ == in_component_;
    return has_enough_robots && is_team_ready && waiting_iterations_ > team_->ticks / 2;
}

inline void CooperativeState::reset() {
    executing_ = others_entering_ = in_component_ = 0;
    waiting_iterations_ = is_entering_ ? waiting_iterations_ + 1 : 0;
    is_entering_ = false;
}

#if defined(BICA_HOST)
inline Team::~Team() {
    for (CooperativeState* state = first_; state != nullptr; state = state->next_) {
        state->team_ = nullptr;
    }
}
#endif

inline void Team::prepare() {
    is_alone_ = false;
    clear();
}

inline void Team::clear() {
    size = 1;
    for (CooperativeState* state = first_; state != nullptr; state = state->next_) {
        state->reset();
    }
}

inline CooperativeState* Team::find(const StateKey& key) {
    CooperativeState* state = first_;
    while (state != nullptr && !(state->key_ == key)) {
        state = state->next_;
    }
    return state;
}

inline void Team::hear(const TeamMessage& message) {
    ++size;
    for (const StateKey& key : message.executed) {
        if (CooperativeState* state = find(key)) {
            ++state->executing_;
        }
    }
    for (const StateKey& key : message.entering) {
        if (CooperativeState* state = find(key)) {
            const bool is_first = state->others_entering_++ == 0;
            state->highest_priority_ = is_first ? message.priority : max(state->highest_priority_, message.priority);
        }
    }
    for (const StateKey& key : message.near) {
        if (CooperativeState* state = find(key)) {
            ++state->in_component_;
        }
    }
}

inline TeamMessage Team::tell() const {
    TeamMessage message;
    message.priority = priority;
    for (const CooperativeState* state = first_; state != nullptr; state = state->next_) {
        if (!state->component_.was_stepped()) {
            continue;
        }
        message.near.add(state->key_);
        if (std::strcmp(state->component_.state_name(), state->key_.state) == 0) {
            message.executed.add(state->key_);
        } else if (state->is_entering_) {
            message.entering.add(state->key_);
        }
    }
    return message;
}

#endif

#if defined(BICA_HOST)

/// The monotonic clock of the machine.
inline Nanoseconds clock_ns() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// Steps the root component in real time, once per tick, until `is_stopping` returns true. Missed ticks are skipped.
template <class Main, class Stopping>
void run(Root& root, Main& main, Nanoseconds tick_ns, Stopping is_stopping) {
    const Nanoseconds start = clock_ns();
    Nanoseconds due = 0;
    while (!is_stopping()) {
        root.step(main, due);
        const Nanoseconds passed = clock_ns() - start;
        due = max(due + tick_ns, (passed + tick_ns - 1) / tick_ns * tick_ns);
        std::this_thread::sleep_for(std::chrono::nanoseconds(due - passed));
    }
}

#if !defined(BICA_NO_NAMES)

/// Times of the steps of one component, including those of the components that it steps.
struct CycleTimes {
    const Component* component = nullptr;
    std::int64_t count = 0;
    Nanoseconds total_ns = 0;
    Nanoseconds longest_ns = 0;
};

/// Measures the steps of up to `Capacity` components.
template <std::size_t Capacity = 64>
class CycleStatistics final : public Observer {
public:
    void begin_step(const Component&, bool, bool) override {
        if (depth_ < Capacity) {
            starts_[depth_] = clock_ns();
        }
        ++depth_;
    }
    void end_step(const Component& component) override {
        --depth_;
        CycleTimes* times = depth_ < Capacity ? find(component) : nullptr;
        if (times != nullptr) {
            const Nanoseconds duration = clock_ns() - starts_[depth_];
            ++times->count;
            times->total_ns += duration;
            times->longest_ns = max(times->longest_ns, duration);
        }
    }
    void error(const Component&, const char*) override {}

    const CycleTimes* begin() const { return times_.data(); }
    const CycleTimes* end() const { return times_.data() + size_; }

private:
    CycleTimes* find(const Component& component) {
        for (std::size_t index = 0; index < size_; ++index) {
            if (times_[index].component == &component) {
                return &times_[index];
            }
        }
        if (size_ == Capacity) {
            return nullptr;
        }
        times_[size_].component = &component;
        return &times_[size_++];
    }

    std::array<CycleTimes, Capacity> times_{};
    std::array<Nanoseconds, Capacity> starts_{};
    std::size_t size_ = 0;
    std::size_t depth_ = 0;
};

/// The text as a literal of JSON; bytes that are no UTF-8 become U+FFFD.
inline std::string json_text(const char* text) {
    std::string result = "\"";
    while (*text != '\0') {
        const auto byte = static_cast<unsigned char>(*text);
        const int more = byte < 0x80 ? 0 : byte >= 0xc2 && byte < 0xe0 ? 1 : byte >= 0xe0 && byte < 0xf0 ? 2 : byte >= 0xf0 && byte < 0xf5 ? 3 : -1;
        int found = 0;
        while (found < more && (static_cast<unsigned char>(text[found + 1]) & 0xc0) == 0x80) {
            ++found;
        }
        if (byte < 0x20 || byte == 0x7f || found != more) {
            std::array<char, 8> code{};
            std::snprintf(code.data(), code.size(), "\\u%04x", found != more ? 0xfffdU : static_cast<unsigned>(byte));
            result.append(code.data());
            ++text;
            continue;
        }
        result.append(byte == '"' || byte == '\\' ? "\\" : "").append(text, static_cast<std::size_t>(more) + 1);
        text += more + 1;
    }
    return result.append("\"");
}

/// Writes a trace (docs/traces.md): one line per iteration.
class TraceWriter final : public Observer {
public:
    explicit TraceWriter(std::FILE* file) : file_(file) {
        std::fputs("{\"vicode-trace\": 1, \"runtime\": \"bica\", \"language\": \"cpp\"}\n", file_);
    }

    /// Also writes the values that a component provides without work, such as those of the world, before each iteration.
    /// `Components::add_inputs_to` adds all of them: a replay needs them.
    void add_input(const Component& component) { inputs_.push_back(&component); }

    /// Writes the iteration that has just ended; nothing before the first one.
    void end_iteration(const Root& root) {
        if (size_ == 0) {
            return;
        }
        std::fprintf(file_, "{\"iteration\": %lld, \"time_ns\": %lld, \"tree\": [", to_long(root.iteration()), to_long(root.now_ns()));
        for (std::size_t index = 0; index < size_; ++index) {
            std::fprintf(file_, "%s%s", index == 0 ? "" : ", ", steps_[index].c_str());
        }
        std::fprintf(file_, "], \"errors\": [%s]%s}\n", errors_.c_str(), input_text_.c_str());
        input_text_.clear();
        size_ = 0;
        errors_.clear();
    }

    void begin_step(const Component& component, bool is_modulated, bool works) override {
        if (active_.empty() && !inputs_.empty()) {
            read_inputs();
        }
        if (size_ == steps_.size()) {
            steps_.emplace_back();
        }
        std::string& text = steps_[size_];
        text.assign("{\"component\": ").append(json_text(component.name()));
        text.append(", \"by\": ").append(active_.empty() ? "null" : json_text(active_.back().component->name()));
        const char* link = is_modulated ? "modulates" : "requires";
        text.append(", \"link\": ").append(json_text(active_.empty() ? "root" : link));
        text.append(", \"worked\": ").append(works ? "true" : "false").append(", \"parameters\": {");
        if (is_modulated) {
            Values values(text);
            component.visit_parameters(values);
        }
        text.append("}");
        active_.push_back({&component, size_++});
    }

    void end_step(const Component& component) override {
        std::string& text = steps_[active_.back().step];
        active_.pop_back();
        text.append(", \"state\": ").append(json_text(component.state_name()));
        text.append(", \"state_time_ns\": ").append(std::to_string(component.state_time_ns()));
        text.append(", \"component_time_ns\": ").append(std::to_string(component.component_time_ns()));
        text.append(", \"changed_from\": ").append(component.left_state() != nullptr ? json_text(component.left_state()) : "null");
        text.append(", \"transition\": ").append(component.transition() != nullptr ? json_text(component.transition()) : "null");
        text.append(", \"done\": ").append(component.is_done() ? "true" : "false").append(", \"values\": {");
        Values values(text);
        component.visit_values(values);
        text.append("}}");
    }

    void error(const Component& component, const char* what) override {
        errors_.append(errors_.empty() ? "" : ", ").append("{\"component\": ").append(json_text(component.name()));
        errors_.append(", \"state\": ").append(json_text(component.state_name())).append(", \"message\": ").append(json_text(what)).append("}");
    }

private:
    struct Active {
        const Component* component;
        std::size_t step;
    };

    void read_inputs() {
        input_text_.assign(", \"inputs\": {");
        for (const Component* component : inputs_) {
            input_text_.append(input_text_.back() == '{' ? "" : ", ").append(json_text(component->name())).append(": {");
            Values values(input_text_);
            component->visit_inputs(values);
            input_text_.append("}");
        }
        input_text_.append("}");
    }

    class Values final : public ValueVisitor {
    public:
        explicit Values(std::string& text) : text_(text) {}
        void visit(const char* name, bool value) override { add(name).append(value ? "true" : "false"); }
        void visit(const char* name, std::int64_t value) override { add(name).append(std::to_string(value)); }
        void visit(const char* name, double value) override {
            if (!std::isfinite(value)) {
                const char* infinity = value > 0 ? "\"inf\"" : "\"-inf\"";
                add(name).append(std::isnan(value) ? "\"nan\"" : infinity);
                return;
            }
            std::array<char, 32> digits{};
            std::snprintf(digits.data(), digits.size(), "%.17g", value);
            std::string& text = add(name).append(digits.data());
            text.append(std::strpbrk(digits.data(), ".e") == nullptr ? ".0" : "");
        }
        void visit(const char* name, const char* enumeration, const char* element) override {
            add(name).append(json_text((std::string(enumeration) + "." + element).c_str()));
        }

    private:
        std::string& add(const char* name) {
            text_.append(text_.back() == '{' ? "" : ", ").append(json_text(name)).append(": ");
            return text_;
        }

        std::string& text_;
    };

    static long long to_long(std::int64_t value) { return value; }

    std::FILE* file_;
    std::vector<std::string> steps_;
    std::vector<Active> active_;
    std::vector<const Component*> inputs_;
    std::string input_text_;
    std::string errors_;
    std::size_t size_ = 0;
};

#endif

#endif

BICA_CLOSE
}  // namespace bica
