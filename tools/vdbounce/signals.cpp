// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/safe_file.h"

#include <atomic>
#include <csignal>
#include <string>

#include <unistd.h>

namespace vdbounce::tool {
namespace {

std::atomic<bool> requested{false};
std::atomic<bool> atOnce{false};
std::atomic<bool> ending{false};
constexpr int kExitInterrupted = 130;

// What is printed by a handler must be there before.
const std::string& lastWords()
{
    static const std::string text =
        std::string(::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") + "vdbounce: error: " + Interrupted().what() + "\n";
    return text;
}

void onSignal(int /*signal*/)
{
    if (atOnce) {
        // Another thread's handler is at it.
        if (ending.exchange(true)) return;
        removeUncommittedFiles();
        const std::string& text = lastWords();
        if (::write(STDERR_FILENO, text.data(), text.size()) < 0) ::_exit(kExitInterrupted);
        ::_exit(kExitInterrupted);
    }
    if (requested.exchange(true)) {
        removeUncommittedFiles();
        ::_exit(kExitInterrupted);
    }
}

} // namespace

void handleInterrupts()
{
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    // A reader that went away shows as a failed write, which is reported like any other.
    std::signal(SIGPIPE, SIG_IGN);
}

void endAtOnceWhenInterrupted()
{
    lastWords();
    atOnce = true;
    throwIfInterrupted(); // by a signal that came before
}

void throwIfInterrupted()
{
    if (interruptRequested()) throw Interrupted();
}

bool interruptRequested() { return requested.load(std::memory_order_relaxed); }

} // namespace vdbounce::tool
