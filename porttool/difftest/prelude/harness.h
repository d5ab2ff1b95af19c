// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Runs the functions of one side on inputs that porttool drew: compiled before them, after vectors.h.
//
//     PROGRAM list                   the inputs and outputs of every function, a line each
//     PROGRAM run N INPUTS OUTPUTS   function N on every record of INPUTS
//
// A record is one slot of eight bytes a number, an output record has a slot before them: 0, or 1 where the function did
// not come back (a division by zero, a wild pointer, a loop without end).
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
#include <tuple>

namespace porttool_harness {

struct Param {
    const char* name;
    int count;  ///< elements behind a pointer
};

template <class T>
constexpr bool kIsNumber = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, _Float16>;

template <class T>
const char* kind_of() {
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

/// Prints a line for each number: direction, parameter, kind, path. Without std::string, whose header would take longer
/// to compile than most subjects.
struct Lister {
    const char* direction;
    int param;
    size_t count = 0;
    size_t length = 0;  ///< of `path`, and of what no longer fits
    char path[1000] = {};

    Lister(const char* direction_of, int number) : direction(direction_of), param(number) {}

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
    void number(T&) {
        constexpr size_t kMost = 2048;  // more is nobody's input
        if (++count == kMost) unusable("many");
        if (count >= kMost) return;
        if (length >= sizeof path) return unusable("deep");
        std::printf("%s %d %s %s\n", direction, param, kind_of<T>(), path);
    }
    void unusable(const char* why) { std::printf("bad %d %s %s\n", param, why, path); }

private:
    void append(const char* text) {
        const size_t more = std::strlen(text);
        if (length + more < sizeof path) std::memcpy(path + length, text, more + 1);
        length += more;
    }
};

struct Loader {
    const uint64_t* at;
    size_t enter(const char*) { return 0; }
    void leave(size_t) {}
    template <class T>
    void number(T& x) {
        const uint64_t slot = *at++;
        auto& to = const_cast<std::remove_const_t<T>&>(x);
        if constexpr (std::is_same_v<std::remove_const_t<T>, float>)
            to = std::bit_cast<float>(static_cast<uint32_t>(slot));
        else if constexpr (std::is_same_v<std::remove_const_t<T>, double>)
            to = std::bit_cast<double>(slot);
        else if constexpr (std::is_same_v<std::remove_const_t<T>, _Float16> ||
                           std::is_floating_point_v<std::remove_const_t<T>>)
            to = static_cast<std::remove_const_t<T>>(std::bit_cast<float>(static_cast<uint32_t>(slot)));
        else if constexpr (std::is_same_v<std::remove_const_t<T>, bool>)
            to = slot != 0;
        else
            to = static_cast<std::remove_const_t<T>>(static_cast<int64_t>(slot));
    }
    void unusable(const char*) {}
};

struct Storer {
    uint64_t* at;
    size_t enter(const char*) { return 0; }
    void leave(size_t) {}
    template <class T>
    void number(T& x) {
        if constexpr (std::is_same_v<std::remove_const_t<T>, float>)
            *at++ = std::bit_cast<uint32_t>(x);
        else if constexpr (std::is_same_v<std::remove_const_t<T>, double>)
            *at++ = std::bit_cast<uint64_t>(x);
        else if constexpr (std::is_same_v<std::remove_const_t<T>, _Float16> ||
                           std::is_floating_point_v<std::remove_const_t<T>>)
            *at++ = std::bit_cast<uint32_t>(static_cast<float>(x));
        else
            *at++ = static_cast<uint64_t>(static_cast<int64_t>(x));
    }
    void unusable(const char*) {}
};

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
        v.unusable("pointer");
    } else if constexpr (std::is_union_v<Bare>) {
        v.unusable("union");
    } else if constexpr (requires { porttool_visit(const_cast<Bare&>(x), v); }) {
        porttool_visit(const_cast<Bare&>(x), v);
    } else {
        v.unusable("layout");
    }
    v.leave(before);
}

// ---- Functions that others stand in for ----

/// What they answer depends on this number of the record, on which of them is asked, and on what it is asked.
inline uint64_t answers = 0;

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
        uint64_t slot = 0;
        Storer{&slot}.number(x);
        take(slot);
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
        if constexpr (std::is_same_v<T, bool>)
            x = (bits & 1) != 0;
        else if constexpr (std::is_enum_v<T>)
            x = static_cast<T>(bits % 4);
        else if constexpr (std::is_integral_v<T>)
            x = static_cast<T>(bits % 3 == 0 ? bits >> 4 : (bits >> 4) % 16);
        else {
            const double unit = static_cast<double>((bits >> 4) & 0xffffff) * 0x1p-24;
            x = static_cast<T>(bits % 3 == 0 ? 2 * unit - 1 : unit);
        }
    }
    void unusable(const char*) {}
};

/// The answer of function `number`: the same on both sides for the same arguments.
template <class R, class... A>
R answered(int number, A... arguments) {
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
constexpr int kGuess = 64;                ///< elements, of subject.cpp
constexpr size_t kMostOfGuess = 1 << 14;  ///< bytes: of what is larger there is one

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
    Stored* values = nullptr;
    std::remove_cvref_t<A> pointer = {};

    explicit Holder(int elements) requires kPointer : count(elements < 1 ? 1 : elements), pointer() {
        const bool is_guess = count == kGuess;
        if (is_guess && sizeof(Stored) * kGuess > kMostOfGuess) count = 1;
        values = static_cast<Stored*>(
            is_guess ? guarded(static_cast<size_t>(count) * sizeof(Stored))
                     : std::calloc(static_cast<size_t>(count) + 8, sizeof(Stored) < 64 ? 64 : sizeof(Stored)));
    }
    template <class V>
    void visit(V& v, const char* name) {
        if constexpr (!kUsable) {
            v.unusable("type");
        } else if (count == 1) {
            walk(v, name, *values);
        } else {
            const size_t before = v.enter(name);
            char index[24];
            for (int i = 0; i < count; ++i) {
                std::snprintf(index, sizeof index, "[%d]", i);
                walk(v, index, values[i]);
            }
            v.leave(before);
        }
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

inline sigjmp_buf came_back;
inline volatile sig_atomic_t inside = 0, ticks = 0;

inline void on_trap(int) {
    if (inside) siglongjmp(came_back, 1);
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

/// `Globals` visits the variables that are inputs.
template <class Globals, class R, class... A>
struct Runner {
    using Function = R (*)(A...);

    template <size_t... I>
    static void list(const Param* params, const Globals& globals, bool has_answers, std::index_sequence<I...>) {
        std::tuple<Holder<A>...> held{Holder<A>(params[I].count)...};
        (list_in(std::get<I>(held), static_cast<int>(I), params[I].name), ...);
        Lister in("in", 9000);
        globals(in);
        if (has_answers) std::printf("in 9999 u4 (answers)\n");
        if constexpr (!std::is_void_v<R>) {
            Lister out("out", -1);
            if constexpr (std::is_pointer_v<R>) {
                out.unusable("returned");
            } else {
                Holder<std::remove_cvref_t<R>> result(1);
                result.visit(out, "");
            }
        }
        (list_out(std::get<I>(held), static_cast<int>(I), params[I].name), ...);
        if (Globals::kHasNotes)
            for (int i = 0; i < kNotes; ++i) std::printf("out 9500 f4 (calls)[%d]\n", i);
    }
    template <class H>
    static void list_in(H& holder, int place, const char* name) {
        Lister in("in", place);
        holder.visit(in, name);
    }
    template <class H>
    static void list_out(H& holder, int place, const char* name) {
        if constexpr (H::kOut) {
            Lister out("out", place);
            holder.visit(out, name);
        }
    }

    template <size_t... I>
    static void run(Function function, const Param* params, const Globals& globals, const uint64_t* in, size_t in_slots,
                    uint64_t* out, size_t out_slots, size_t records, std::index_sequence<I...>) {
        std::tuple<Holder<A>...> held{Holder<A>(params[I].count)...};
        for (size_t record = 0; record < records; ++record, in += in_slots, out += out_slots) {
            Loader loader{in};
            (std::get<I>(held).visit(loader, ""), ...);
            globals(loader);
            answers = loader.at < in + in_slots ? *loader.at : 0;
            out[0] = 1;
            if (Globals::kHasNotes) {
                std::memset(notes, 0, sizeof notes);
                note_count = 0;
            }
            if (sigsetjmp(came_back, 0) == 0) {
                ticks = 0;
                inside = 1;
                Storer storer{out + 1};
                if constexpr (std::is_void_v<R>) {
                    function(std::get<I>(held).pass()...);
                    inside = 0;
                } else {
                    auto result = function(std::get<I>(held).pass()...);
                    inside = 0;
                    if constexpr (!std::is_pointer_v<R>) walk(storer, "", result);
                }
                (store_out(storer, std::get<I>(held)), ...);
                if (Globals::kHasNotes)
                    for (float& note : notes) storer.number(note);
                out[0] = 0;
            } else {
                inside = 0;
                for (size_t i = 1; i < out_slots; ++i) out[i] = 0;
            }
        }
    }
    template <class H>
    static void store_out(Storer& storer, H& holder) {
        if constexpr (H::kOut) holder.visit(storer, "");
    }
};

struct Subject {
    int number;
    void (*list)();
    void (*run)(const uint64_t* in, size_t in_slots, uint64_t* out, size_t out_slots, size_t records);
};

template <class Globals, class R, class... A>
void list(R (*)(A...), const Param* params, const Globals& globals, bool has_answers) {
    Runner<Globals, R, A...>::list(params, globals, has_answers, std::index_sequence_for<A...>());
}
template <class Globals, class R, class... A>
void run(R (*function)(A...), const Param* params, const Globals& globals, const uint64_t* in, size_t in_slots,
         uint64_t* out, size_t out_slots, size_t records) {
    Runner<Globals, R, A...>::run(function, params, globals, in, in_slots, out, out_slots, records,
                                  std::index_sequence_for<A...>());
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
               out_slots = static_cast<size_t>(std::atoll(argv[4])),
               records = static_cast<size_t>(std::atoll(argv[7]));
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
