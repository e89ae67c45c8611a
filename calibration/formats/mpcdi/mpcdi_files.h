#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/mpcdi/xml_element.h"

namespace ergodome {

//! Reads the maps and masks that filesets of an MPCDI description name.
class MpcdiFileReader {
 public:
  MpcdiFileReader(MpcdiFiles files, RowOrder order) : files_(std::move(files)), order_(order) {}

  //! Reads one <fileset> into its region. Throws Error where the profile needs what is not there.
  void read(const XmlElement& fileset, const Mpcdi& mpcdi, MpcdiRegion& region) const;

 private:
  [[nodiscard]] std::optional<FloatMap> read_map(const XmlElement& element) const;
  [[nodiscard]] std::optional<MpcdiMask> read_mask(const XmlElement& element) const;
  [[nodiscard]] std::optional<MpcdiGeometry> read_geometry(const XmlElement& element, MpcdiProfile profile) const;

  MpcdiFiles files_;
  RowOrder order_;
};

//! Returns the path of a file that a description in `folder` names. If no file has exactly this name, its
//! case is ignored, as on Windows.
std::filesystem::path file_beside(const std::filesystem::path& folder, const std::string& name);

//! Files that lie beside a description. Only what is below `folder` is opened: names with a drive, from the root, or through ".."
//! are refused, and so are links that lead out of it.
MpcdiFiles files_in_folder(const std::filesystem::path& folder);

}  // namespace ergodome
