#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace ergodome {

//! The exception of the project: where the error occurred, what is wrong, and what the user can do.
//!
//! It is in the lowest folder so that every folder can throw it. Functors of kernels never throw.
class Error : public std::runtime_error {
 public:
  //! `location` is a file with line or key ("show.toml:12", "rays.csv: row 7"), or the current
  //! command; may be empty. `remedy` is a sentence in the imperative; empty if no advice applies.
  Error(std::string location, std::string problem, std::string remedy = {})
      : std::runtime_error(compose(location, problem, remedy)),
        location_(std::move(location)),
        problem_(std::move(problem)),
        remedy_(std::move(remedy)) {}

  [[nodiscard]] const std::string& location() const noexcept { return location_; }
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  [[nodiscard]] const std::string& remedy() const noexcept { return remedy_; }

 private:
  static std::string compose(const std::string& location, const std::string& problem, const std::string& remedy) {
    std::string text = location.empty() ? problem : location + ": " + problem;
    if (!remedy.empty()) {
      text += "; " + remedy;
    }
    return text;
  }

  std::string location_;
  std::string problem_;
  std::string remedy_;
};

}  // namespace ergodome
