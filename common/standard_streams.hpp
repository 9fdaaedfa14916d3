// Standard output and error that are full, closed, or that nobody reads any more.
#pragma once

namespace navjit::common {

/// To be called first: puts something that cannot be used in the place of standard streams that are
/// closed, so that no file takes their number; and lets writing beyond a limit or into a pipe that
/// is not read fail instead of ending the process.
void secure_standard_streams();

/// Writes what is still in the buffer. Throws Error if anything that was ever printed
/// could not be written.
void finish_standard_output();

}  // namespace navjit::common
