// How a command ends when it is told to.
#pragma once

namespace overlook::command {

// SIGINT, SIGTERM, SIGHUP and SIGPIPE remove the files that are not finished and then end the process as they would have done, so
// that its exit status names the signal. A signal that whoever started us ignores stays ignored. SIGXFSZ (a file grown over the
// limit) is ignored: the write fails with its reason instead.
void install_signal_handlers();

}  // namespace overlook::command
