#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "control/sinumerik/data_store.hpp"

/// The machine and setting data of the measuring cycles, one table for reading, defaults and documentation. Cycle
/// software 4.4; data that version dropped are not in the table.
namespace probewright::control::sinumerik {

struct MeasuringDatum {
  int number = 0;               ///< 54600
  std::string_view identifier;  ///< "$SNS_MEA_WP_BALL_DIAM"
  int elements = 0;             ///< indices 0 to elements - 1; 0: no index
  double initial = 0;
  std::string_view unit;  ///< "mm", "mm/min", ... or empty
  std::string_view meaning;
  std::string_view gud = {};  ///< name in programs of older cycles, such as "_WP"; may be empty
  int gudElement = -1;        ///< last index under that name: _WP[n,gudElement]; -1: the index of the datum itself
  int gudRow = -1;            ///< first index under that name: _MT_EC_R[gudRow,n]; -1: none
};

std::span<const MeasuringDatum> measuringData();
const MeasuringDatum* findMeasuringDatum(std::string_view identifier);
const MeasuringDatum* findMeasuringDatum(int number);

/// The table and the mask bits as a page of documentation (docs/measuring-data.md).
std::string measuringDataPage();

/// Makes the initial values the defaults of `store`; R parameters default to 0.
void setMeasuringDefaults(DataStore& store);

/// The bits of the four function masks.
struct MaskBit {
  std::string_view identifier;  ///< "$SCS_MEA_FUNCTION_MASK"
  int bit = 0;
  bool initial = false;
  std::string_view meaning;
  std::string_view gud = {};  ///< "_CHBIT"; may be empty
  int gudElement = 0;
};
std::span<const MaskBit> maskBits();
bool maskBit(const DataStore& store, std::string_view identifier, int bit);
void setMaskBit(DataStore& store, std::string_view identifier, int bit, bool value);

/// What a name of the older cycles (_WP, _KB, _TP, _TPW, _CM, _EV, _MV, _SPEED, _CBIT, _CHBIT, E_MESS_...) stands for,
/// or nothing. Several data for a _CBIT or _CHBIT that is now one bit for workpieces and one for tools.
struct GudTarget {
  DataKey key;
  int bit = -1;  ///< of a mask; -1: the whole datum
};
std::vector<GudTarget> gudTargets(const DataKey& key);

/// Reads and writes through the old names; read: the first target. Nothing, or false, if the name isn't one of them.
std::optional<double> readGud(const DataStore& store, const DataKey& key);
bool writeGud(DataStore& store, const DataKey& key, double value);

}  // namespace probewright::control::sinumerik
