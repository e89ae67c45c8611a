#pragma once

#include <limits>
#include <string>

#include "calibration/formats/mpcdi/mpcdi_reader.h"
#include "tests/calibration/handmade_files.h"
#include "tests/support/errors.h"

// Calibrations written by hand from the specifications of VESA MPCDI 1.0 and 2.0, with spellings
// found in files of other programs.
namespace ergodome::test {

//! A calibration with profile 2d of MPCDI version 2: two projectors side by side, with the tag
//! names of the specification.
inline const std::string media_xml = R"(<?xml version="1.0" encoding="UTF-8"?>
<MPCDI profile="2d" geometry="1" color="3" date="2015-03-01 12:00:00" version="2.0">
  <display>
    <buffer id="wall" xResolution="3840" yResolution="1080">
      <region id="left" x="0" y="0" xSize="0.5" ySize="1" xResolution="1920" yResolution="1080">
        <color>
          <decode type="gamma" gamma="2.2"/>
          <correct type="none"/>
          <encode type="gamma"><gamma>2.4</gamma></encode>
        </color>
      </region>
      <region id="right" x="0.5" y="0.25" xSize="0.5" ySize="0.5" xResolution="1280" yResolution="1024"/>
    </buffer>
  </display>
  <files>
    <fileset region="left">
      <geometryWarpFile><path>left.pfm</path><interpolation>linear</interpolation></geometryWarpFile>
      <alphaMap><path>left.png</path><bitDepth>8</bitDepth><componentDepth>1</componentDepth>
        <gammaEmbedded>2.2</gammaEmbedded></alphaMap>
      <betaMap><path>beta.png</path><bitDepth>16</bitDepth><componentDepth>3</componentDepth></betaMap>
    </fileset>
    <fileset region="right">
      <geometryWarpFile><path>right.pfm</path><interpolation>smooth</interpolation></geometryWarpFile>
      <alphaMap><path>left.png</path><bitDepth>8</bitDepth><componentDepth>1</componentDepth>
        <gammaEmbedded>1</gammaEmbedded></alphaMap>
      <betaMap><path>beta.png</path><bitDepth>16</bitDepth><componentDepth>3</componentDepth></betaMap>
    </fileset>
  </files>
</MPCDI>
)";

//! A calibration with profile sl of MPCDI version 2, with the tag names of Christie's programs:
//! xResolution next to xsize, empty paths instead of files. The axes are those of surveyors: x to
//! the right, y forward, z up.
inline const std::string lamps_xml = R"(<?xml version="1.0" encoding="utf-8"?>
<MPCDI profile="sl" geometry="2" color="1" date="2018-11-16 19:30:11" version="2.0">
  <display>
    <buffer id="dome">
      <region id="P1" xResolution="1400" yResolution="1050" x="0" y="0" xsize="1" ysize="1">
        <frustum><yaw>90</yaw><pitch>0</pitch><roll>0</roll>
          <rightAngle>30</rightAngle><leftAngle>-25</leftAngle><upAngle>20</upAngle><downAngle>-15</downAngle></frustum>
        <coordinateFrame>
          <posx>1.5</posx><posy>-2</posy><posz>3</posz>
          <yawx>0</yawx><yawy>0</yawy><yawz>-1</yawz>
          <pitchx>1</pitchx><pitchy>0</pitchy><pitchz>0</pitchz>
          <rollx>0</rollx><rolly>1</rolly><rollz>0</rollz>
        </coordinateFrame>
      </region>
    </buffer>
  </display>
  <files/>
  <fileset region="P1">
    <geometryWarpFile><geometricUnit>m</geometricUnit><originOf3DData>floorCenter</originOf3DData>
      <path></path><interpolation>unknown</interpolation></geometryWarpFile>
    <alphaMap><bitDepth>8</bitDepth><componentDepth>1</componentDepth><gammaEmbedded>1.0</gammaEmbedded><path></path></alphaMap>
    <distortionMap><path></path></distortionMap>
  </fileset>
</MPCDI>
)";

inline const float unknown_sample = std::numeric_limits<float>::quiet_NaN();

//! Returns a warp file with 2 x 2 samples, one of which is marked as unknown. The first row of the
//! file is the bottom row.
inline std::string left_warp() {
  return pfm_by_hand(2, 2, {0.1F, 0.8F, 0, 0.9F, 0.7F, 0, 0.25F, 0.25F, 0, unknown_sample, unknown_sample, 1});
}

inline std::string right_warp() { return pfm_by_hand(2, 2, {0, 1, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0}); }
inline std::string grey_mask() { return png_by_hand(2, 2, 1, 8, {0, 51, 102, 255}); }
inline std::string colour_mask() { return png_by_hand(2, 2, 3, 16, {0, 0, 0, 0, 0, 0, 0, 0, 0, 65535, 13107, 0}); }

inline std::vector<ZipMember> media_members(const std::string& xml) {
  return {{"mpcdi.xml", xml},
          {"left.pfm", left_warp()},
          {"right.pfm", right_warp()},
          {"left.png", grey_mask()},
          {"beta.png", colour_mask()}};
}

inline Mpcdi parsed_archive(const std::string& bytes, RowOrder order = RowOrder::bottom_up) {
  return parse_mpcdi_archive(std::as_bytes(std::span(bytes)), "test.mpcdi", order);
}

inline Mpcdi parsed_media(const std::string& xml) { return parsed_archive(zip_by_hand(media_members(xml))); }

//! Parses a description that refers to no files.
inline Mpcdi parsed_lamps(const std::string& xml) {
  const auto none = [](const std::string& name, std::size_t) -> std::string { throw Error(name, "is not there"); };
  return parse_mpcdi_description(xml, "test.mpcdi.xml", none, RowOrder::bottom_up);
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace ergodome::test
