#include "jit/detail/source_check.hpp"

#include <clang/Basic/LangOptions.h>
#include <clang/Lex/Lexer.h>

#include <algorithm>
#include <string>

namespace navjit::jit::detail {
namespace {

// The parser takes up to 5.5 KiB of stack for each token. It has 256 MiB.
constexpr unsigned max_tokens = 32768;

bool ends_expression(const clang::Token& token) {
  return token.isOneOf(clang::tok::semi, clang::tok::comma, clang::tok::l_brace,
                       clang::tok::r_brace);
}

}  // namespace

std::optional<Failure> too_deep(std::string_view source, std::string_view unit_name) {
  if (source.size() <= max_tokens) return std::nullopt;
  const std::string text(source);  // the lexer wants a terminating zero
  clang::LangOptions language;
  language.CPlusPlus = language.CPlusPlus11 = language.CPlusPlus14 = language.CPlusPlus17 =
      language.CPlusPlus20 = true;
  clang::Lexer lexer(clang::SourceLocation(), language, text.c_str(), text.c_str(),
                     text.c_str() + text.size());
  unsigned tokens = 0;
  for (clang::Token token; !lexer.LexFromRawLexer(token);) {
    tokens = ends_expression(token) ? 0 : tokens + 1;
    if (tokens <= max_tokens) continue;
    const auto line = 1 + std::count(text.c_str(), lexer.getBufferLocation(), '\n');
    return Failure{std::string(unit_name) + ':' + std::to_string(line) +
                   ": error: expression of more than " + std::to_string(max_tokens) + " tokens"};
  }
  return std::nullopt;
}

}  // namespace navjit::jit::detail
