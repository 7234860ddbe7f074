#pragma once

namespace knap {

bool is_terminal(int descriptor);
/// Columns of a terminal, 0 when not known.
int terminal_width(int descriptor);
/// Whether text may hold characters beyond ASCII, by the locale's environment variables.
bool shows_utf8();

}  // namespace knap
