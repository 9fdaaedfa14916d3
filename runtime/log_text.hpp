// Makes texts from outside (compiler, files, names in detectors) fit for one line of the log.
#pragma once

#include <string>
#include <string_view>

namespace navjit {

/// The text's lines joined by " | ", with control characters replaced by '?', cut to `most` bytes.
std::string one_line(std::string_view text, std::size_t most = 1000);

/// The same for the value of key=value: in double quotes, with quotes and backslashes escaped.
std::string in_quotes(std::string_view text, std::size_t most = 200);

}  // namespace navjit
