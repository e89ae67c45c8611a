#include "content/stars/star_table.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include "content/files/printable.h"
#include "content/files/reading_stop.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t most_stars = 100'000'000;
constexpr std::size_t longest_cell = 65'536;
constexpr std::size_t chunk_bytes = 1U << 18U;

enum Column { ra_deg, ra_hours, dec_deg, magnitude, colour, catalogue_number, distance, column_count };

//! Magnitude of what is so near that it is the Sun, for which catalogues have a distance of 0.
constexpr double brightest_but_the_sun = -20.0;

//! What a problem calls a column.
constexpr const char* column_words[column_count] = {"a right ascension", "a right ascension", "a declination",
                                                    "a magnitude",       "a colour",          "a catalogue's number",
                                                    "a distance"};

//! Colours are farther than this from 0 where catalogues write 99 for one that is not known.
constexpr double most_colour = 20.0;

//! Names under which catalogues have a column, in capitals or not; HYG: ra in hours, dec, mag, ci.
constexpr std::pair<std::string_view, Column> column_names[] = {
    {"ra_deg", ra_deg}, {"radeg", ra_deg},    {"ra", ra_hours},          {"dec_deg", dec_deg},     {"dedeg", dec_deg},
    {"dec", dec_deg},   {"v_mag", magnitude}, {"vmag", magnitude},       {"mag", magnitude},       {"b_v", colour},
    {"b-v", colour},    {"ci", colour},       {"hip", catalogue_number}, {"id", catalogue_number}, {"dist", distance}};

//! All of them, by what they hold, for who has named none of a kind.
constexpr const char* all_column_names =
    "right ascension: ra_deg or RAdeg in degrees, ra in hours; declination: dec_deg, DEdeg or dec; magnitude: v_mag, "
    "Vmag or mag; where they are known, colour: b_v, B-V or ci; number: hip or id; distance: dist";

std::optional<Column> column_named(std::string_view name) {
  const auto same = [](char known, char given) {
    return known == (given >= 'A' && given <= 'Z' ? static_cast<char>(given - 'A' + 'a') : given);
  };
  for (const auto& [known, column] : column_names) {
    if (std::ranges::equal(known, name, same)) {
      return column;
    }
  }
  return std::nullopt;
}

//! True if a cell stands for a number that is not known, in the words of Gaia's archive and VizieR.
bool is_blank(std::string_view cell) {
  constexpr std::string_view blanks[] = {"", "null", "NULL", "nan", "NaN", "--", "---"};
  return std::ranges::find(blanks, cell) != std::end(blanks);
}

//! Returns the character between the cells of a header: comma, semicolon or tab, whichever it has most of.
char separator_of(std::string_view text) {
  const std::string_view header = text.substr(0, text.find_first_of("\r\n"));
  char most = ',';
  for (const char separator : {';', '\t'}) {
    most = std::ranges::count(header, separator) > std::ranges::count(header, most) ? separator : most;
  }
  return most;
}

//! Throws Error if a file is compressed, or no text of single bytes.
void require_plain_text(std::string_view text, const std::string& file) {
  if (text.starts_with("\x1F\x8B")) {
    throw Error(file, "is compressed (gzip)", "unpack it with gunzip");
  }
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw Error(file, "is text in UTF-16", "save it as UTF-8");
  }
}

//! Takes cells and rows from the parser. It must not throw through the parser's frames: the first problem is kept.
class TableBuilder {
 public:
  explicit TableBuilder(std::string file) : file_(std::move(file)) {}

  //! Sets the character between cells.
  void set_separator(char separator) { separator_ = separator; }

  void take_cell(std::string_view cell) {
    if (problem_) {
      return;
    }
    if (cell.find('\n') != std::string_view::npos) {
      count_lines(cell);
    }
    if (in_header_) {
      name_column(cell);
    } else if (cell_ < columns_.size() && columns_[cell_]) {
      take_number(*columns_[cell_], cell);
    } else if (cell_ >= named_ && !cell.empty()) {
      fail(fmt::format("has more cells than the {} that the first line names", named_),
           "name every column, and put cells that hold commas in quotes");
    }
    ++cell_;
  }

  //! `end` is the character that ended it; a carriage return has a line feed behind it.
  void end_row(int end) {
    if (!problem_ && cell_ > 0) {
      in_header_ ? end_header() : end_star();
    }
    line_ += lines_in_row_ + (end != '\r' ? 1 : 0);
    lines_in_row_ = 0;
    cell_ = 0;
    values_.fill(std::numeric_limits<double>::quiet_NaN());
  }

  //! Throws the first problem.
  void check() const {
    if (problem_) {
      throw Error(*problem_);
    }
  }

  StarCatalogue take() {
    check();
    if (in_header_) {
      throw Error(file_, "is empty", "name the columns in its first line: ra_deg,dec_deg,v_mag,b_v");
    }
    sort_by_brightness(catalogue_.stars);
    return std::move(catalogue_);
  }

  void fail(const std::string& problem, const std::string& remedy) {
    if (!problem_) {
      problem_ = Error(fmt::format("{}:{}", file_, line_), problem, remedy);
    }
  }

 private:
  //! Counts the lines that a cell in quotes ends. A quote that is closed in another row swallows one with each of them, which the commas tell: in a name there
  //! may well be an end of a line, but not as many commas as in a row.
  void count_lines(std::string_view cell) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(cell, '\n'));
    const auto commas = static_cast<std::size_t>(std::ranges::count(cell, separator_));
    if (!in_header_ && named_ > 1 && commas >= (named_ - 1) * lines) {
      leave_out({"within quotes that go on into the next line", lines, line_ + lines_in_row_, false});
    }
    lines_in_row_ += lines;
  }

  void leave_out(const RowsLeftOut& rows) {
    const auto known = std::ranges::find(catalogue_.left_out, rows.why, &RowsLeftOut::why);
    if (known == catalogue_.left_out.end()) {
      catalogue_.left_out.push_back(rows);
    } else {
      known->count += rows.count;
    }
  }

  void name_column(std::string_view cell) {
    if (cell_ == 0 && cell.starts_with("\xEF\xBB\xBF")) {
      cell.remove_prefix(3);
    }
    auto column = column_named(cell);
    // The first of several names wins: HYG has hip after id, but a star is known by its first catalogue_number.
    if (column && *column == catalogue_number && has_[catalogue_number]) {
      column.reset();
    }
    if (column) {
      if (has_[*column]) {
        fail(fmt::format("has two columns for {}", column_words[*column]), "leave one of them, or rename it");
      }
      has_[*column] = true;
    }
    if (columns_.size() < 4096) {
      columns_.push_back(column);
    }
  }

  void end_header() {
    in_header_ = false;
    named_ = cell_;
    values_.fill(std::numeric_limits<double>::quiet_NaN());
    std::string missing;
    const auto require = [&](bool there, Column column) {
      if (!there) {
        missing += fmt::format("{}{}", missing.empty() ? "" : ", ", column_words[column]);
      }
    };
    require(has_[ra_deg] || has_[ra_hours], ra_deg);
    require(has_[dec_deg], dec_deg);
    require(has_[magnitude], magnitude);
    if (!missing.empty()) {
      fail(fmt::format("names no column for {}", missing),
           fmt::format("name them in the first line, in capitals or not; {}", all_column_names));
    }
  }

  void take_number(Column column, std::string_view cell) {
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '+')) {
      cell.remove_prefix(1);
    }
    while (!cell.empty() && cell.back() == ' ') {
      cell.remove_suffix(1);
    }
    if (is_blank(cell)) {
      return;
    }
    // Where semicolons separate cells, commas are decimal points.
    std::string point;
    if (separator_ == ';' && cell.find(',') != std::string_view::npos) {
      point = cell;
      std::ranges::replace(point, ',', '.');
      cell = point;
    }
    if (cell.find('\n') != std::string_view::npos) {
      return fail(fmt::format("has a cell of more than one line where {} should be", column_words[column]),
                  "close its quotes");
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      return fail(fmt::format("has \"{}\" where {} should be", printable(cell.substr(0, 40)), column_words[column]),
                  "write a number, or nothing");
    }
    values_[column] = value;
  }

  void end_star() {
    const double ra = has_[ra_deg] ? values_[ra_deg] : 15.0 * values_[ra_hours];
    const double dec = values_[dec_deg];
    const double v_mag = values_[magnitude];
    if (!std::isfinite(ra) || !std::isfinite(dec)) {
      return leave_out({"without a place", 1, line_, false});
    }
    if (!std::isfinite(v_mag)) {
      return leave_out({"without a magnitude", 1, line_, false});
    }
    // Other stars have a distance of 0 where it is not known.
    if (has_[distance] && values_[distance] == 0.0 && v_mag < brightest_but_the_sun) {
      return leave_out({"of the Sun", 1, line_, true});
    }
    if (std::abs(dec) > 90.0 || std::abs(ra) > 360.0) {
      return fail(fmt::format("has a star at right ascension {} deg, declination {} deg", ra, dec),
                  "places are within 360 and 90 degrees; a column ra is in hours, ra_deg in degrees");
    }
    if (v_mag < -30.0 || v_mag > 60.0) {
      return fail(fmt::format("has a star of magnitude {}", v_mag), "magnitudes are between -30 and 60");
    }
    if (catalogue_.stars.size() >= most_stars) {
      return fail("has more than 100 million stars", "leave the faint ones out");
    }
    const double own = values_[catalogue_number];
    const bool counted = own >= 0.0 && own <= 4e9;
    const bool coloured = std::abs(values_[colour]) <= most_colour;
    const double b_v = coloured ? values_[colour] : std::numeric_limits<double>::quiet_NaN();
    catalogue_.stars.push_back({counted ? static_cast<std::uint32_t>(own) : 0U, std::fmod(ra + 360.0, 360.0), dec,
                                static_cast<float>(v_mag), static_cast<float>(b_v)});
  }

  std::string file_;
  std::size_t line_ = 1;          //!< where the row begins
  std::size_t lines_in_row_ = 0;  //!< that cells of it have ended
  std::size_t cell_ = 0;
  std::size_t named_ = 0;  //!< columns of the header
  bool in_header_ = true;
  char separator_ = ',';
  std::vector<std::optional<Column>> columns_;
  std::array<bool, column_count> has_{};
  std::array<double, column_count> values_{};
  StarCatalogue catalogue_;
  std::optional<Error> problem_;
};

//! The library's parser, freed at the end.
class CsvParser {
 public:
  CsvParser() {
    if (csv_init(&parser_, CSV_REPALL_NL) != 0) {
      throw std::bad_alloc();
    }
  }
  ~CsvParser() { csv_free(&parser_); }
  CsvParser(const CsvParser&) = delete;
  CsvParser& operator=(const CsvParser&) = delete;

  void set_separator(char separator) { csv_set_delim(&parser_, static_cast<unsigned char>(separator)); }

  void parse(std::string_view text, TableBuilder& table) {
    if (csv_parse(&parser_, text.data(), text.size(), &take_cell, &end_row, &table) != text.size()) {
      table.fail(csv_strerror(csv_error(&parser_)), "write comma-separated values");
    }
    // A quote that is never closed swallows the rest of the file.
    if (csv_get_buffer_size(&parser_) > longest_cell) {
      table.fail("has a cell of more than 64 KiB", "close the quotes");
    }
  }

  void finish(TableBuilder& table) {
    // Strict at the end alone: a quote within a cell that has none about it is no mistake.
    csv_set_opts(&parser_, CSV_REPALL_NL | CSV_STRICT | CSV_STRICT_FINI);
    if (csv_fini(&parser_, &take_cell, &end_row, &table) != 0) {
      table.fail("has a quote that is not closed before the file ends", "close it");
    }
  }

 private:
  static void take_cell(void* cell, std::size_t length, void* table) {
    static_cast<TableBuilder*>(table)->take_cell({static_cast<const char*>(cell), cell != nullptr ? length : 0});
  }
  static void end_row(int end, void* table) { static_cast<TableBuilder*>(table)->end_row(end); }

  csv_parser parser_{};
};

}  // namespace

StarCatalogue parse_star_table(std::istream& stream, const std::string& file) {
  TableBuilder table(file);
  CsvParser parser;
  std::string chunk(chunk_bytes, '\0');
  for (bool first = true; stream; first = false) {
    require_reading_goes_on(file);
    stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const std::string_view text(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (first) {
      require_plain_text(text, file);
      parser.set_separator(separator_of(text));
      table.set_separator(separator_of(text));
    }
    parser.parse(text, table);
    table.check();
  }
  if (stream.bad()) {
    throw Error(file, "cannot be read", "check its disk");
  }
  parser.finish(table);
  return table.take();
}

StarCatalogue read_star_table(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(path.string(), "cannot be opened", "check the path and its permissions");
  }
  return parse_star_table(stream, path.string());
}

}  // namespace ergodome
