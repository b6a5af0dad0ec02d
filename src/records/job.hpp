#pragma once

#include <array>
#include <string>

namespace probewright::records {

/// What the head of an inspection report says of the part and of who measured it. Whatever is empty is left out.
struct Job {
  std::string part;       ///< number or name on the drawing
  std::string drawing;    ///< with its revision
  std::string order;      ///< number of the order or batch
  std::string serial;     ///< number of this part
  std::string operator_;  ///< who ran the program
  std::string company;
};

/// The fields by the names that setups, command line and results.json use.
struct JobField {
  const char* name;
  std::string Job::*value;
};
inline constexpr std::array<JobField, 6> jobFields = {{{"part", &Job::part},
                                                       {"drawing", &Job::drawing},
                                                       {"order", &Job::order},
                                                       {"serial", &Job::serial},
                                                       {"operator", &Job::operator_},
                                                       {"company", &Job::company}}};

}  // namespace probewright::records
