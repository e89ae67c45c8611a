#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "calibration/formats/mpcdi/xml_element.h"

namespace ergodome {

//! Reads the maps and masks that the filesets of an MPCDI description name.
class MpcdiFileReader {
 public:
  MpcdiFileReader(MpcdiFiles files, RowOrder order) : files_(std::move(files)), order_(order) {}

  //! Reads one <fileset> into its region. Throws Error if files are missing that the profile
  //! requires.
  void read(const XmlElement& fileset, const Mpcdi& mpcdi, MpcdiRegion& region) const;

 private:
  [[nodiscard]] std::optional<FloatMap> read_map(const XmlElement& element) const;
  [[nodiscard]] std::optional<MpcdiMask> read_mask(const XmlElement& element) const;
  [[nodiscard]] std::optional<MpcdiGeometry> read_geometry(const XmlElement& element, MpcdiProfile profile) const;

  MpcdiFiles files_;
  RowOrder order_;
};

//! Returns the path of a file that a description in `folder` names. If no file has exactly this
//! name, its case is ignored, as on Windows.
std::filesystem::path file_beside(const std::filesystem::path& folder, const std::string& name);

//! Returns a reader of the files beside a description. Opens only files below `folder`: throws
//! Error for names with a drive, absolute names, names with "..", and links that lead outside.
MpcdiFiles files_in_folder(const std::filesystem::path& folder);

}  // namespace ergodome
