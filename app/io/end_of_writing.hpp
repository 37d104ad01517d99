#pragma once

namespace kinetix::app {

/// Removes what is unfinished (atomic_file.hpp), also what other threads are writing: from then on none of their files comes to its place, and the
/// program must end. For programs that write from several threads, and so handle interrupts themselves.
void remove_unfinished_of_others();

}  // namespace kinetix::app
