#include "runtime/command/signals.h"

#include <csignal>

#include "formats/atomic_file.h"

namespace overlook::command {
namespace {

// Installed with SA_RESETHAND: the signal raised again waits until the handler returns and then takes its default action.
extern "C" void leave_nothing_half_written(int signal_number) {
    remove_unfinished_files();
    raise(signal_number);
}

}  // namespace

void install_signal_handlers() {
    for (int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        struct sigaction before {};
        if (sigaction(signal_number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = leave_nothing_half_written;
        sigemptyset(&action.sa_mask);
        action.sa_flags = int(SA_RESETHAND);
        sigaction(signal_number, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace overlook::command
