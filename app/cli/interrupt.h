#pragma once

namespace ergodome {

//! From now on Ctrl-C (SIGINT) and SIGTERM only ask for a stop; a second one ends the program at once.
void catch_interrupts();

//! From now on SIGHUP asks for a stop as well, however often it comes.
void stop_on_hangup();

//! From now on a file that grows beyond the limit that a user may have is one that cannot be written, as on a full disk, and not the end of the program.
void fail_at_file_limits();

//! Whether a stop was asked for.
bool interrupted();

//! From now on SIGINT and SIGTERM end the program at once, for work that asks nobody whether to go on and writes whole files alone.
void end_on_interrupts();

}  // namespace ergodome
