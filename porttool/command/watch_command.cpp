// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "porttool/command/commands.h"
#include "porttool/live/finding_changes.h"
#include "porttool/live/live_project.h"
#include "porttool/read/glob.h"
#include "porttool/read/stop_signal.h"
#include "porttool/report/check_report.h"
#include "porttool/report/watch_report.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using WatchClock = std::chrono::steady_clock;

int64_t milliseconds_since(WatchClock::time_point then) {
    return std::chrono::duration_cast<std::chrono::milliseconds>(WatchClock::now() - then).count();
}

constexpr int kLookForReaderMs = 2000;

/// True once the other end of a pipe is closed: who started us is gone, and may have been killed.
bool is_without_reader() {
    pollfd out{STDOUT_FILENO, 0, 0};
    return ::poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

/// Judges a project again and again, and prints what became different.
class Watcher {
public:
    Watcher(const Options& options, Workplace& place)
        : place_(place),
          project_(options, place.disk),
          json_(options.format == "json"),
          verbose_(options.verbose),
          color_(options.color == "always" ||
                 (options.color == "auto" && isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr)) {}

    /// Returns the exit code. Throws CannotDo where there is nothing to judge at the start.
    int run() {
        const StopSignal stop;
        look({});
        if (project_.watch().is_polling()) place_.err << FileWatch::polling_note();
        while (stop.exit_code() == 0) {
            const Woken woken = project_.watch().wait(stop.descriptor(), kLookForReaderMs);
            if (is_without_reader()) throw CannotDo("stdout cannot be written: nobody reads it any more");
            if (woken != Woken::Changed) continue;
            const std::set<std::string> files = changed_files();
            try {
                look(files);
            } catch (const CannotDo& problem) {
                tell_error(problem.what());
            } catch (const GlobTooLarge& problem) {
                tell_error(terminal_lines(problem.what()));
            }
        }
        return stop.exit_code();
    }

private:
    void look(const std::set<std::string>& files) {
        const auto start = WatchClock::now();
        const Judgement& now = project_.look().judgement;
        const std::chrono::duration<double, std::milli> took = WatchClock::now() - start;
        if (said_ != project_.said()) place_.err << project_.said() << std::flush;
        said_ = project_.said();
        const bool is_judged_again = !error_.empty();
        error_.clear();
        const FindingChanges changes = changes_between(before_, now.findings, json_ ? Moves::Count : Moves::Pass);
        const WatchStep step{changes, now, files, milliseconds_since(start_), took.count()};
        std::string text = json_ ? watch_json(step) : watch_text(step, color_);
        if (!json_ && (!started_ || is_judged_again) && text.empty()) text = summary_text(now);
        started_ = true;
        root_ = project_.last().project.root;
        if (!text.empty()) print(*place_.out, as_utf8(text));
        if (verbose_ && !json_) tell_look(step);
        before_ = now.findings;
    }

    void tell_look(const WatchStep& step) {
        place_.err << fmt::format("looked again in {:.0f} ms:", step.look_ms);
        for (const std::string& file : step.files) place_.err << " " << terminal_text(file);
        place_.err << std::endl;
    }

    /// A project that cannot be judged while somebody is at it is told once, and tried again with the next change.
    void tell_error(const std::string& message) {
        if (message == error_) return;
        error_ = message;
        if (json_)
            print(*place_.out, as_utf8(watch_error_json(message, milliseconds_since(start_))));
        else
            place_.err << "porttool: " << message << std::endl;
    }

    /// The files that woke us, as seen from the root where they lie there.
    std::set<std::string> changed_files() {
        std::set<std::string> out;
        const std::string folder = root_ + "/";
        for (const std::string& file : project_.watch().take_changed())
            out.insert(file.starts_with(folder) ? file.substr(folder.size()) : file);
        return out;
    }

    Workplace& place_;
    LiveProject project_;
    const bool json_, verbose_, color_;
    const WatchClock::time_point start_ = WatchClock::now();
    std::vector<Finding> before_;
    std::string said_, error_, root_;
    bool started_ = false;
};

}  // namespace

void declare_watch(Declare&, Options&) {}

Outcome run_watch(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    if (!options.output.empty())
        throw CannotDo("watch prints as files are saved, until it is stopped; in place of -o redirect its output");
    return {"", Watcher(options, place).run()};
}

}  // namespace porttool
