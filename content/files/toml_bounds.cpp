#include "content/files/toml_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Scans TOML by its punctuation alone. A string or comment ends where the parser, toml++ 3.3, ends
//! it or would report an error.
class TomlScan {
 public:
  TomlScan(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void run() {
    while (at_ < text_.size()) {
      step(text_[at_]);
      ++at_;
    }
  }

 private:
  void step(char c) {
    switch (c) {
      case '\n':
        end_line();
        break;
      case '#':
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
        break;
      case '"':
      case '\'':
        skip_string(c);
        begin_line();
        break;
      case '.':
        require(++dots_ < max_toml_key_parts, "has a key of more than {} parts", max_toml_key_parts);
        break;
      case '=':
        count_dotted(dots_);
        count_value();
        dots_ = 0;
        break;
      case ',':
        // A comma in an array precedes a value. In an inline table it precedes a key, which is
        // counted at its equals sign.
        if (depth_ > 0 && open_[depth_ - 1] == '[') {
          count_value();
        }
        dots_ = 0;
        break;
      case '[':
      case '{':
        open(c);
        break;
      case ']':
      case '}':
        depth_ = std::max(depth_ - 1, 0);
        break;
      default:
        if (c != ' ' && c != '\t') {
          begin_line();
        }
    }
  }

  void begin_line() { line_begun_ = true; }

  void end_line() {
    ++line_;
    line_begun_ = false;
    dots_ = 0;
  }

  void open(char bracket) {
    if (bracket == '[' && depth_ == 0 && !line_begun_) {
      count_header();
    }
    begin_line();
    require(depth_ < deepest_toml_nesting, "nests brackets deeper than {} levels", deepest_toml_nesting);
    open_[depth_++] = bracket;
    count_value();
    dots_ = 0;
  }

  //! Counts the table header that begins here, unless it repeats the previous one.
  void count_header() {
    const std::string_view line = text_.substr(at_, text_.find('\n', at_) - at_);
    if (line != header_) {
      header_ = line;
      // The parser rejects headers with more parts than this, so further ones need not be counted.
      count_dotted(1 + std::min<long>(std::ranges::count(line, '.'), max_toml_key_parts));
    }
  }

  void count_dotted(long parts) {
    dotted_ += parts;
    require(dotted_ <= max_toml_dotted_parts, "has more than {} parts in dotted keys and table headers",
            max_toml_dotted_parts);
  }

  void count_value() { require(++values_ <= max_toml_values, "has more than {} values", max_toml_values); }

  //! Goes to the last character of a string; if it is not closed, to the end of the text or line.
  void skip_string(char quote) {
    const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
    const bool multi_line = text_.substr(at_).starts_with(triple);
    for (at_ += multi_line ? 3 : 1; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\\' && quote == '"') {
        ++at_;
        line_ += at_ < text_.size() && text_[at_] == '\n' ? 1 : 0;
      } else if (c == '\n' && !multi_line) {
        --at_;
        return;
      } else if (c == '\n') {
        ++line_;
      } else if (!multi_line && c == quote) {
        return;
      } else if (multi_line && text_.substr(at_).starts_with(triple)) {
        // Up to two quotes before the closing three belong to the string's text.
        const std::string_view quotes = text_.substr(at_, 5);
        at_ += std::min(quotes.find_first_not_of(quote), quotes.size()) - 1;
        return;
      }
    }
  }

  void require(bool holds, std::string_view problem, long limit) const {
    if (!holds) {
      throw Error(fmt::format("{}:{}", file_, line_), fmt::format(fmt::runtime(problem), limit),
                  "check that this is the right file, or simplify it on that line");
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  long line_ = 1;
  bool line_begun_ = false;
  std::string_view header_;
  std::array<char, deepest_toml_nesting> open_{};
  int depth_ = 0;
  int dots_ = 0;
  long values_ = 0;
  long dotted_ = 0;
};

}  // namespace

void require_bounded_toml(std::string_view text, const std::string& file) { TomlScan(text, file).run(); }

}  // namespace ergodome
