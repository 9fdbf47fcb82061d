/// Standard input, output and error.
#pragma once

namespace halfspace {

/// Call it before any file is opened. Where one is closed (`>&-`), a file would get its number, and the table
/// would go into it; now reading or writing there fails (as GNU's stdopen() does).
void hold_standard_streams();

/// Writes out what is left of the standard output. Throws std::system_error, as fmt::print() does, where it
/// cannot.
void flush_standard_output();

}  // namespace halfspace
