#pragma once

namespace ergodome {

//! Makes SIGINT (Ctrl-C) and SIGTERM request a stop; a second one of the same kind ends the program
//! at once.
void catch_interrupts();

//! Makes SIGHUP request a stop as well, however often it comes.
void stop_on_hangup();

//! Makes writing beyond the user's limit on file sizes fail as on a full disk, instead of ending
//! the program.
void fail_at_file_limits();

//! Returns whether a stop was requested.
bool interrupted();

//! Makes SIGINT and SIGTERM end the program at once, for work that cannot be interrupted and writes
//! only whole files.
void end_on_interrupts();

}  // namespace ergodome
