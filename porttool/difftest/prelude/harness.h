// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Runs the functions of one side on inputs that porttool drew: compiled before them, after vectors.h.
//
//     PROGRAM list                   the inputs and outputs of every function, a line each
//     PROGRAM run N INPUTS OUTPUTS   function N on every record of INPUTS
//
// A record is one slot of eight bytes a number, an output record has a slot before them: 0, or 1 where the function did
// not come back (a division by zero, a wild pointer, a loop without end), or how many answers it got where these were
// so many that the last were all alike.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>  // and with it std::min and its like, which many subjects use
#include <csetjmp>
#include <csignal>
#include <cstdio>
#include <new>
#include <utility>

namespace porttool_harness {

struct Param {
    const char* name;
    int count;  ///< elements behind a pointer
};

template <class T>
constexpr bool kIsNumber = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, _Float16>;

template <class T>
constexpr const char* kind_of() {
    if constexpr (std::is_same_v<T, bool>)
        return "b1";
    else if constexpr (std::is_same_v<T, _Float16>)
        return "f2";
    else if constexpr (std::is_enum_v<T>)
        return "e4";
    else if constexpr (std::is_floating_point_v<T>)
        return sizeof(T) == 4 ? "f4" : sizeof(T) == 8 ? "f8" : "f16";
    else if constexpr (std::is_signed_v<T>)
        return sizeof(T) == 1 ? "i1" : sizeof(T) == 2 ? "i2" : sizeof(T) == 4 ? "i4" : "i8";
    else
        return sizeof(T) == 1 ? "u1" : sizeof(T) == 2 ? "u2" : sizeof(T) == 4 ? "u4" : "u8";
}

/// What a number takes from its slot.
template <class T>
void load(void* at, uint64_t slot) {
    auto& to = *static_cast<T*>(at);
    if constexpr (std::is_same_v<T, float>)
        to = std::bit_cast<float>(static_cast<uint32_t>(slot));
    else if constexpr (std::is_same_v<T, double>)
        to = std::bit_cast<double>(slot);
    else if constexpr (std::is_same_v<T, _Float16> || std::is_floating_point_v<T>)
        to = static_cast<T>(std::bit_cast<float>(static_cast<uint32_t>(slot)));
    else if constexpr (std::is_same_v<T, bool>)
        to = slot != 0;
    else
        to = static_cast<T>(static_cast<int64_t>(slot));
}

/// The slot of a number.
template <class T>
uint64_t stored(const void* at) {
    const auto& x = *static_cast<const T*>(at);
    if constexpr (std::is_same_v<T, float>)
        return std::bit_cast<uint32_t>(x);
    else if constexpr (std::is_same_v<T, double>)
        return std::bit_cast<uint64_t>(x);
    else if constexpr (std::is_same_v<T, _Float16> || std::is_floating_point_v<T>)
        return std::bit_cast<uint32_t>(static_cast<float>(x));
    else
        return static_cast<uint64_t>(static_cast<int64_t>(x));
}

struct NumberType {
    const char* kind;
    bool is_word;  ///< its four bytes are the low ones of its slot
    void (*load)(void* at, uint64_t slot);
    uint64_t (*stored)(const void* at);
};
template <class T>
constexpr NumberType kNumberType = {kind_of<T>(), std::is_same_v<T, float> || std::is_same_v<T, uint32_t>, load<T>,
                                    stored<T>};

/// Memory for an array whose length is a guess: who looks behind it, or a page before it, does not come back.
inline void* guarded(size_t size) {
    const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
    const size_t room = (size + page - 1) / page * page;
    void* const all = mmap(nullptr, room + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) _exit(4);
    char* const first = static_cast<char*>(all) + page;
    if (mprotect(first, room, PROT_READ | PROT_WRITE) != 0) _exit(4);
    return first + room - size;
}
constexpr int kGuess = 64;                ///< elements, of subject.h
constexpr int kFewGuess = 9;              ///< the same of structs, of pointers, and behind a second pointer
constexpr size_t kMostOfGuess = 1 << 14;  ///< bytes: of what is larger there is one

/// What pointers in structs lead to.
struct Reached {
    char* first;
    size_t size, element;
    const void* pointer;  ///< the one that leads there at first
};
constexpr int kMostReached = 4096;
inline Reached reached[kMostReached];
inline int reached_count = 0;

/// Where a pointer leads: 0 for nowhere, 1 for the first element of its array, and so on; more for another one's, by
/// whatever name that goes on the other side; -1 for elsewhere.
inline uint64_t place_of(const void* at) {
    const char* const leads = *static_cast<const char* const*>(at);
    if (leads == nullptr) return 0;
    for (int i = 0; i < reached_count; ++i)
        if (leads >= reached[i].first && leads <= reached[i].first + reached[i].size)
            return (reached[i].pointer == at ? 1 : 1000001) +
                   static_cast<size_t>(leads - reached[i].first) / reached[i].element;
    return ~uint64_t{0};
}
inline constexpr NumberType kPointerType = {"i8", false, nullptr, place_of};

/// A number of the inputs or outputs in memory.
struct Place {
    void* at;
    const NumberType* type;
};

/// Visits the inputs or the outputs of a function once. For `list` it prints a line for each number: direction,
/// parameter, kind, path; for `run` it notes where they are, for what is made for every type of every subject takes
/// most of the time to compile. Without std::string and std::vector, whose headers would take longer than most
/// subjects.
struct Layout {
    const char* direction;  ///< nullptr: for `run`
    bool is_input;
    int depth = 0;  ///< pointers that were followed
    int param = 0;
    size_t count = 0;   ///< numbers of this parameter, listed or noted
    size_t length = 0;  ///< of `path`, and of what no longer fits
    char path[1000] = {};
    Place* places = nullptr;
    size_t place_count = 0, room = 0;
    struct Kept {
        void** at;
        void* value;
    };
    Kept* kept = nullptr;  ///< pointers that every record begins with
    size_t kept_count = 0;

    Layout(const char* direction_of, bool of_inputs) : direction(direction_of), is_input(of_inputs) {}
    ~Layout() {
        std::free(places);
        std::free(kept);
    }
    Layout(const Layout&) = delete;
    Layout& operator=(const Layout&) = delete;

    void begin(int number) {
        param = number;
        count = 0;
    }
    size_t enter(const char* name) {
        const size_t before = length;
        if (length > 0 && name[0] != '[' && name[0] != 0) append(".");
        append(name);
        return before;
    }
    void leave(size_t before) {
        length = before;
        if (length < sizeof path) path[length] = 0;
    }
    template <class T>
    void number(T& x) {
        add(const_cast<std::remove_const_t<T>*>(&x), kNumberType<std::remove_const_t<T>>);
    }
    void unusable(const char* why) {
        if (direction) std::printf("bad %d %s %s\n", param, why, path);
    }
    /// A pointer that leads to an array, whose length is a guess.
    void keep(void** at) {
        kept = static_cast<Kept*>(std::realloc(kept, (kept_count + 1) * sizeof(Kept)));
        if (kept == nullptr) _exit(4);
        kept[kept_count++] = {at, *at};
        guess();
    }
    /// What is visited has fewer elements than a guess else has, or is no parameter.
    void guess() const {
        if (direction) std::printf("guess %d x %s\n", param, path);
    }
    void pointer(void* at) { add(at, kPointerType); }

private:
    void add(void* at, const NumberType& type) {
        ++count;
        if (!direction) return note({at, &type});
        constexpr size_t kMost = 2048;  // more is nobody's input
        if (count == kMost) unusable("many");
        if (count >= kMost) return;
        if (length >= sizeof path) return unusable("deep");
        std::printf("%s %d %s %s\n", direction, param, type.kind, path);
    }
    void note(Place place) {
        if (place_count == room) {
            room = 2 * room + 64;
            places = static_cast<Place*>(std::realloc(places, room * sizeof(Place)));
            if (places == nullptr) _exit(4);
        }
        places[place_count++] = place;
    }
    void append(const char* text) {
        const size_t more = std::strlen(text);
        if (length + more < sizeof path) std::memcpy(path + length, text, more + 1);
        length += more;
    }
};

inline void load_all(const Layout& layout, const uint64_t* slots) {
    for (size_t i = 0; i < layout.kept_count; ++i) *layout.kept[i].at = layout.kept[i].value;
    const Place* const end = layout.places + layout.place_count;
    for (const Place* place = layout.places; place != end; ++place, ++slots)
        if (place->type->is_word)
            *static_cast<uint32_t*>(place->at) = static_cast<uint32_t>(*slots);
        else
            place->type->load(place->at, *slots);
}

inline void store_all(const Layout& layout, uint64_t* slots) {
    const Place* const end = layout.places + layout.place_count;
    for (const Place* place = layout.places; place != end; ++place, ++slots)
        *slots = place->type->is_word ? *static_cast<const uint32_t*>(place->at) : place->type->stored(place->at);
}

template <class V, class T>
void walk(V& v, const char* name, T& x);

/// Counts the numbers of a value.
struct Counter {
    size_t count = 0;
    size_t enter(const char*) { return 0; }
    void leave(size_t) {}
    template <class T>
    void number(T&) {
        ++count;
    }
    void unusable(const char*) {}
};

/// How many of `most` values there are to be, so that nobody has to draw too many numbers: 0 where there are `taken`
/// already and not one more fits.
template <class T>
int count_within(int most, size_t taken = 0) {
    void* const one = std::calloc(1, sizeof(T));
    if (one == nullptr) _exit(4);
    Counter counter;
    walk(counter, "", *static_cast<T*>(one));
    std::free(one);
    constexpr size_t kMost = 1900;
    const auto count = static_cast<size_t>(most);
    if (taken > 0 && taken + counter.count > kMost) return 0;
    if (taken > 0 && taken + counter.count * count > kMost) return 1;
    if (counter.count * count <= kMost && count * sizeof(T) <= kMostOfGuess) return most;
    const size_t fits = kMost / (counter.count + 1);
    return fits < 2 || kFewGuess * sizeof(T) > kMostOfGuess ? 1 : fits < kFewGuess ? static_cast<int>(fits) : kFewGuess;
}

/// True for what a pointer may lead to where an array of them is to be drawn.
template <class V, class T>
constexpr bool kIsHeld = kIsNumber<T> || std::is_pointer_v<T> || requires(V& v, T& x) {
    porttool_visit(x, v);
};

/// A pointer in a struct: an array, behind at most two of them; nowhere beyond.
template <class V, class T>
void walk_pointer(V& v, T*& x) {
    using Bare = std::remove_cv_t<T>;
    if constexpr (!std::is_same_v<V, Layout> || std::is_function_v<Bare> || std::is_void_v<Bare>) {
        v.unusable("pointer");
    } else if constexpr (!kIsHeld<V, Bare>) {
        v.unusable("pointer");
    } else {
        constexpr int kDeepest = 2;
        if (v.depth == kDeepest) return;
        int count = 0;
        if (v.is_input) {
            constexpr int kDeepGuess = 2;  // of structs behind a second pointer, which may lead on
            count = count_within<Bare>(
                kIsNumber<Bare> ? (v.depth == 0 ? kGuess : kFewGuess) : (v.depth == 0 ? kFewGuess : kDeepGuess),
                v.count + 1);
            if (count == 0 || reached_count == kMostReached) return;  // it leads nowhere
            const size_t size = static_cast<size_t>(count) * sizeof(Bare);
            x = static_cast<Bare*>(guarded(size));
            reached[reached_count++] = {reinterpret_cast<char*>(const_cast<Bare*>(x)), size, sizeof(Bare), &x};
            v.keep(reinterpret_cast<void**>(const_cast<Bare**>(&x)));
        } else {
            if (v.param < 0) return v.unusable("pointer");  // what is returned leads who knows where
            for (int i = 0; i < reached_count; ++i)
                if (reached[i].pointer == &x) count = static_cast<int>(reached[i].size / reached[i].element);
            if (count == 0) return;
            v.pointer(&x);
        }
        ++v.depth;
        char index[24];
        for (int i = 0; i < count; ++i) {
            std::snprintf(index, sizeof index, "[%d]", i);
            walk(v, index, const_cast<Bare&>(x[i]));
        }
        --v.depth;
    }
}

/// A member by a name that may be a macro, and that of nothing: `x.data`, or `x`.
#define PORTTOOL_MEMBER(x, name) PORTTOOL_MEMBER_OF(x, name)
#define PORTTOOL_MEMBER_OF(x, ...) x __VA_OPT__(.) __VA_ARGS__

/// A field that no text names: what cannot be filled of that stays 0.
template <class V, class T>
void walk_unnamed(V& v, const char* name, T& x) {
    using Bare = std::remove_cv_t<std::remove_all_extents_t<T>>;
    if constexpr (kIsNumber<Bare> || requires { porttool_visit(const_cast<Bare&>(*static_cast<Bare*>(nullptr)), v); })
        walk(v, name, x);
}

template <class V, class T>
void walk(V& v, const char* name, T& x) {
    using Bare = std::remove_cv_t<T>;
    const size_t before = v.enter(name);
    if constexpr (kIsNumber<Bare>) {
        v.number(x);
    } else if constexpr (std::is_array_v<Bare>) {
        char index[24];
        for (size_t i = 0; i < std::extent_v<Bare>; ++i) {
            std::snprintf(index, sizeof index, "[%zu]", i);
            walk(v, index, x[i]);
        }
    } else if constexpr (std::is_pointer_v<Bare>) {
        walk_pointer(v, const_cast<Bare&>(x));
    } else if constexpr (std::is_union_v<Bare>) {
        v.unusable("union");
    } else if constexpr (requires { porttool_visit(const_cast<Bare&>(x), v); }) {
        porttool_visit(const_cast<Bare&>(x), v);
    } else {
        v.unusable("layout");
    }
    v.leave(before);
}

/// A variable of the file: one of the system's, as a lock or a jump buffer, stays empty.
template <class V, class T>
void walk_variable(V& v, const char* name, T& x) {
    using Bare = std::remove_cv_t<std::remove_all_extents_t<T>>;
    if constexpr (std::is_pointer_v<Bare>) {
        if constexpr (kIsHeld<V, std::remove_cv_t<std::remove_pointer_t<Bare>>>) walk(v, name, x);
    } else {
        walk_unnamed(v, name, x);
    }
}

// ---- What ends a call from within ----

inline sigjmp_buf came_back;
inline volatile sig_atomic_t inside = 0, ticks = 0;

/// The call does not come back; does nothing outside of one.
inline void leave_call() {
    if (inside) siglongjmp(came_back, 1);
}

// ---- Functions that others stand in for ----

/// What they answer depends on this number of the record, on which of them is asked, and on what it is asked.
inline uint64_t answers = 0;
inline int answer_count = 0;        ///< in this record
constexpr int kPlentyAnswers = 64;  ///< who asks more than that gets nothing but ends of lists
constexpr int kMostAnswers = 2000;  ///< and more than that, goes on for ever

struct Hasher {
    uint64_t state;
    size_t enter(const char*) { return 0; }
    void leave(size_t) {}
    void take(uint64_t value) {
        state = (state ^ value) * 0x9e3779b97f4a7c15ull;
        state ^= state >> 29;
    }
    template <class T>
    void number(T& x) {
        take(stored<std::remove_const_t<T>>(&x));
    }
    void unusable(const char*) {}
};

struct Answerer {
    Hasher hash;
    size_t enter(const char*) { return 0; }
    void leave(size_t) {}
    template <class T>
    void number(T& x) {
        hash.take(1);
        const uint64_t bits = hash.state >> 20;
        if (answer_count > kPlentyAnswers) {
            if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
                x = static_cast<T>(~uint64_t{0});
            else
                x = T{};
            return;
        }
        if constexpr (std::is_same_v<T, bool>)
            x = (bits & 1) != 0;
        else if constexpr (std::is_enum_v<T>)
            x = static_cast<T>(bits % 4);
        else if constexpr (std::is_integral_v<T>)
            // All ones often mean that there is nothing: by them loops over a list end.
            x = static_cast<T>(bits % 16 == 7 ? ~uint64_t{0} : bits % 3 == 0 ? bits >> 4 : (bits >> 4) % 16);
        else {
            const double unit = static_cast<double>((bits >> 4) & 0xffffff) * 0x1p-24;
            // A mark that is off, or a word of zeros, behind which other branches lie.
            x = static_cast<T>(bits % 8 == 7 ? 0 : bits % 3 == 0 ? 2 * unit - 1 : unit);
        }
    }
    void unusable(const char*) {}
};

/// The answer of function `number`: the same on both sides for the same arguments.
template <class R, class... A>
R answered(int number, A... arguments) {
    if (++answer_count > kMostAnswers) leave_call();
    Hasher hash{0x243f6a8885a308d3ull};
    hash.take(answers);
    hash.take(static_cast<uint64_t>(number));
    (walk(hash, "", arguments), ...);
    Answerer answerer{hash};
    std::remove_cvref_t<R> out{};
    walk(answerer, "", out);
    return out;
}

/// What functions that give nothing were called with: outputs of whoever calls them. A whole number is two of them.
constexpr int kNotes = 48;
inline float notes[kNotes];
inline int note_count = 0;

struct Noter {
    size_t enter(const char*) { return 0; }
    void leave(size_t) {}
    void put(float value) {
        if (note_count < kNotes) notes[note_count++] = value;
    }
    template <class T>
    void number(T& x) {
        if constexpr (std::is_floating_point_v<std::remove_const_t<T>> ||
                      std::is_same_v<std::remove_const_t<T>, _Float16>) {
            put(static_cast<float>(x));
        } else {
            const auto whole = static_cast<uint32_t>(x);
            put(static_cast<float>(whole >> 16));
            put(static_cast<float>(whole & 0xffffu));
        }
    }
    void unusable(const char*) {}
};

template <class... A>
void noted(int number, A... arguments) {
    Noter noter;
    noter.put(static_cast<float>(number));
    (walk(noter, "", arguments), ...);
}

/// A function whose `void*` lead to what it takes them for; `Behind`: void for what is no such parameter.
template <auto kFunction, class... Behind>
struct Typed;
template <class R, class... A, R (*kFunction)(A...), class... Behind>
struct Typed<kFunction, Behind...> {
    template <class P, class B>
    using Parameter = std::conditional_t<std::is_void_v<B>, P,
                                         std::conditional_t<std::is_const_v<std::remove_pointer_t<P>>, const B*, B*>>;
    static R call(Parameter<A, Behind>... arguments) { return kFunction(static_cast<A>(arguments)...); }
};

/// What a parameter of type A is made from: one value, or those behind a pointer.
template <class A>
struct Holder {
    static constexpr bool kPointer = std::is_pointer_v<std::remove_cvref_t<A>>;
    using Value = std::remove_cv_t<
        std::conditional_t<kPointer, std::remove_pointer_t<std::remove_cvref_t<A>>, std::remove_reference_t<A>>>;
    static constexpr bool kUsable = !std::is_void_v<Value> && !std::is_function_v<Value> && !std::is_abstract_v<Value>;
    static constexpr bool kOut = kPointer
                                     ? !std::is_const_v<std::remove_pointer_t<std::remove_cvref_t<A>>>
                                     : std::is_lvalue_reference_v<A> && !std::is_const_v<std::remove_reference_t<A>>;
    using Stored = std::conditional_t<kUsable, Value, int>;

    int count = 1;
    bool is_fewer = false;
    Stored* values = nullptr;
    std::remove_cvref_t<A> pointer = {};

    explicit Holder(int elements) requires kPointer : count(elements < 1 ? 1 : elements), pointer() {
        const bool is_guess = count == kGuess;
        if (is_guess && std::is_pointer_v<Stored>) count = kFewGuess;
        if (is_guess) count = count_within<Stored>(count);
        is_fewer = is_guess && count < kGuess;
        values = static_cast<Stored*>(
            is_guess ? guarded(static_cast<size_t>(count) * sizeof(Stored))
                     : std::calloc(static_cast<size_t>(count) + 8, sizeof(Stored) < 64 ? 64 : sizeof(Stored)));
    }
    template <class V>
    void visit(V& v, const char* name) {
        if constexpr (!kUsable) {
            v.unusable("type");
            return;
        }
        const size_t before = v.enter(name);
        if (is_fewer) v.guess();
        if (count == 1) {
            walk(v, "", *values);
        } else {
            constexpr int kFollowed = std::is_pointer_v<Stored> ? 1 : 0;
            v.depth += kFollowed;
            char index[24];
            for (int i = 0; i < count; ++i) {
                std::snprintf(index, sizeof index, "[%d]", i);
                walk(v, index, values[i]);
            }
            v.depth -= kFollowed;
        }
        v.leave(before);
    }
    A pass() {
        pointer = reinterpret_cast<std::remove_cvref_t<A>>(values);
        return static_cast<A>(pointer);
    }
};

/// A value or a reference. The value is made without a constructor: every number in it is loaded.
template <class A>
requires(!std::is_pointer_v<std::remove_cvref_t<A>>) struct Holder<A> {
    using Value = std::remove_cvref_t<A>;
    static constexpr bool kOut = std::is_lvalue_reference_v<A> && !std::is_const_v<std::remove_reference_t<A>>;
    Value* value;
    explicit Holder(int) : value(static_cast<Value*>(std::aligned_alloc(64, (sizeof(Value) + 127) / 64 * 64))) {
        std::memset(static_cast<void*>(value), 0, sizeof(Value));
    }
    template <class V>
    void visit(V& v, const char* name) {
        walk(v, name, *value);
    }
    A pass() { return static_cast<A>(*value); }
};

inline void on_trap(int) {
    leave_call();
    _exit(3);
}
/// Records that took too long: after so many the function is taken for one that does not come back.
inline int endless = 0;
constexpr int kMostEndless = 16;

inline void on_tick(int) {
    if (!inside || ++ticks <= 4) return;
    if (++endless > kMostEndless) _exit(5);
    siglongjmp(came_back, 1);
}

inline void catch_traps() {
    static char stack[1 << 16];
    stack_t other{};
    other.ss_sp = stack;
    other.ss_size = sizeof stack;
    sigaltstack(&other, nullptr);
    struct sigaction action {};
    action.sa_handler = on_trap;
    action.sa_flags = SA_NODEFER | SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP}) sigaction(signal, &action, nullptr);
    action.sa_handler = on_tick;
    action.sa_flags = SA_NODEFER | SA_ONSTACK | SA_RESTART;
    sigaction(SIGVTALRM, &action, nullptr);
    itimerval every{};
    every.it_interval.tv_usec = every.it_value.tv_usec = 10000;
    setitimer(ITIMER_VIRTUAL, &every, nullptr);
}

/// A function with what it takes and gives, without their types.
struct Frame {
    void (*call)(Frame&);  ///< from and to where `in` and `out` say
    Layout in, out;
    bool has_notes;
};

inline void run_records(Frame& frame, const uint64_t* in, size_t in_slots, uint64_t* out, size_t out_slots,
                        size_t records) {
    for (size_t record = 0; record < records; ++record, in += in_slots, out += out_slots) {
        load_all(frame.in, in);
        answers = frame.in.place_count < in_slots ? in[frame.in.place_count] : 0;
        out[0] = 1;
        answer_count = 0;
        if (frame.has_notes) {
            std::memset(notes, 0, sizeof notes);
            note_count = 0;
        }
        if (sigsetjmp(came_back, 0) == 0) {
            ticks = 0;
            inside = 1;
            frame.call(frame);
            inside = 0;
            store_all(frame.out, out + 1);
            out[0] = answer_count > kPlentyAnswers ? static_cast<uint64_t>(answer_count) : 0;
        } else {
            inside = 0;
            for (size_t i = 1; i < out_slots; ++i) out[i] = 0;
        }
    }
}

}  // namespace porttool_harness

/// Who ends the program gives no answer: exit() of all subjects leads here, as the linker is told.
extern "C" {
[[noreturn]] void __real_exit(int code);
[[noreturn]] inline __attribute__((used)) void __wrap_exit(int code) {
    porttool_harness::leave_call();
    __real_exit(code);
}
}

namespace porttool_harness {

/// Parameter `I`: std::tuple would take longer to compile.
template <size_t I, class A>
struct Held {
    Holder<A> holder;
    explicit Held(const Param* params) : holder(params[I].count) {}
};

/// What a function gives, which is not looked at where it is a pointer.
template <class R>
struct Result {
    static constexpr bool kUsable = !std::is_void_v<R> && !std::is_pointer_v<R>;
    Holder<std::conditional_t<kUsable, R, int>> holder{1};
};

/// `Globals` visits the variables that are inputs, and by `give` those of them that are outputs.
template <class Globals, class Numbers, class R, class... A>
struct Runner;
template <class Globals, size_t... I, class R, class... A>
struct Runner<Globals, std::index_sequence<I...>, R, A...> : Frame, Held<I, A>... {
    using Function = R (*)(A...);
    using Given = std::remove_cvref_t<R>;
    Function function;
    Result<Given> result;

    Runner(Function function_of, const Param* params, bool lists)
        : Frame{call_function, Layout(lists ? "in" : nullptr, true), Layout(lists ? "out" : nullptr, false),
                Globals::kHasNotes},
          Held<I, A>(params)...,
          function(function_of) {}

    void visit_inputs(const Param* params, const Globals& globals) {
        (visit(in, static_cast<int>(I), params[I].name, Held<I, A>::holder), ...);
        globals(in);
    }
    void visit_outputs(const Param* params, const Globals& globals) {
        if constexpr (Result<Given>::kUsable)
            visit(out, -1, "", result.holder);
        else if constexpr (!std::is_void_v<R>)
            out.unusable("returned");
        (visit_output<I, A>(params), ...);
        globals.give(out);
    }

private:
    template <class H>
    static void visit(Layout& layout, int place, const char* name, H& holder) {
        layout.begin(place);
        holder.visit(layout, name);
    }
    template <size_t Place, class P>
    void visit_output(const Param* params) {
        if constexpr (Holder<P>::kOut) visit(out, static_cast<int>(Place), params[Place].name, Held<Place, P>::holder);
    }
    static void call_function(Frame& frame) {
        auto& self = static_cast<Runner&>(frame);
        if constexpr (Result<Given>::kUsable) {
            Given* const at = self.result.holder.value;
            std::memset(static_cast<void*>(at), 0, sizeof(Given));
            ::new (static_cast<void*>(at)) Given(self.function(self.Held<I, A>::holder.pass()...));
        } else {
            self.function(self.Held<I, A>::holder.pass()...);
        }
    }
};

struct Subject {
    int number;
    void (*list)();
    void (*run)(const uint64_t* in, size_t in_slots, uint64_t* out, size_t out_slots, size_t records);
};

template <class Globals, class R, class... A>
void list(R (*function)(A...), const Param* params, const Globals& globals, bool has_answers) {
    Runner<Globals, std::index_sequence_for<A...>, R, A...> runner(function, params, true);
    runner.visit_inputs(params, globals);
    if (has_answers) std::printf("in 9999 u4 (answers)\n");
    runner.visit_outputs(params, globals);
    if (Globals::kHasNotes)
        for (int i = 0; i < kNotes; ++i) std::printf("out 9500 f4 (calls)[%d]\n", i);
}
template <class Globals, class R, class... A>
void run(R (*function)(A...), const Param* params, const Globals& globals, const uint64_t* in, size_t in_slots,
         uint64_t* out, size_t out_slots, size_t records) {
    Runner<Globals, std::index_sequence_for<A...>, R, A...> runner(function, params, false);
    runner.visit_inputs(params, globals);
    runner.visit_outputs(params, globals);
    if (Globals::kHasNotes)
        for (float& note : notes) runner.out.number(note);
    run_records(runner, in, in_slots, out, out_slots, records);
}

/// The first so many slots of a file in memory.
inline uint64_t* mapped(const char* path, bool writes, size_t slots) {
    const int file = open(path, writes ? O_RDWR : O_RDONLY);
    struct stat status {};
    if (file < 0 || fstat(file, &status) != 0 || slots > static_cast<size_t>(status.st_size) / 8) _exit(4);
    void* const at = mmap(nullptr, slots > 0 ? slots * 8 : 8, writes ? PROT_READ | PROT_WRITE : PROT_READ,
                          writes ? MAP_SHARED : MAP_PRIVATE, file, 0);
    if (at == MAP_FAILED) _exit(4);
    return static_cast<uint64_t*>(at);
}

/// Slots a record of inputs, and of outputs, and how many records there are come on the command line: memory may be
/// larger than that.
inline int start(int argc, char** argv, const Subject* subjects, size_t count) {
    if (argc == 2) {
        for (size_t i = 0; i < count; ++i) {
            std::printf("subject %d\n", subjects[i].number);
            subjects[i].list();
        }
        return 0;
    }
    if (argc != 8) return 2;
    const int number = std::atoi(argv[2]);
    const auto in_slots = static_cast<size_t>(std::atoll(argv[3])),
               out_slots = static_cast<size_t>(std::atoll(argv[4])), records = static_cast<size_t>(std::atoll(argv[7]));
    const uint64_t* const in = mapped(argv[5], false, records * in_slots);
    uint64_t* const out = mapped(argv[6], true, records * out_slots);
    catch_traps();
    for (size_t i = 0; i < count; ++i)
        if (subjects[i].number == number) subjects[i].run(in, in_slots, out, out_slots, records);
    return 0;
}

}  // namespace porttool_harness

namespace porttool_prelude {
template <class T, class V>
void porttool_visit(vec1<T>& x, V& v) {
    porttool_harness::walk(v, "x", x.x);
}
template <class T, int N, class V>
void porttool_visit(vec<T, N>& x, V& v) {
    static constexpr const char* kNames[] = {"x", "y", "z", "w"};
    for (int i = 0; i < N; ++i) porttool_harness::walk(v, kNames[i], x.at[i]);
}
template <class T, int C, int R, class V>
void porttool_visit(mat<T, C, R>& x, V& v) {
    static constexpr const char* kNames[] = {"[0]", "[1]", "[2]", "[3]"};
    for (int i = 0; i < C; ++i) porttool_harness::walk(v, kNames[i], x.column[i]);
}
}  // namespace porttool_prelude
