#pragma once

#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.hpp"

namespace probewright::control {

enum class EventKind { Message, Alarm, Stop, Skipped, Tool, Warning };

/// Something the operator would see.
struct EventRecord {
  EventKind kind = EventKind::Message;
  SourcePlace place;
  std::string code;
  std::string text;
  double seconds = 0;
};

/// The events of a run in their order. A program may leave millions of them, so they are kept packed: some 50 bytes and
/// the text each. Iterators and [] give the events by value.
class EventList {
public:
  using value_type = EventRecord;

  class const_iterator {
  public:
    using iterator_concept = std::random_access_iterator_tag;
    using iterator_category = std::input_iterator_tag;
    using value_type = EventRecord;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = EventRecord;

    const_iterator() = default;
    const_iterator(const EventList& list, std::size_t index)
        : list_(&list), index_(static_cast<difference_type>(index)) {}

    EventRecord operator*() const { return (*list_)[static_cast<std::size_t>(index_)]; }
    EventRecord operator[](difference_type n) const { return *(*this + n); }
    const_iterator& operator++() { return *this += 1; }
    const_iterator& operator--() { return *this -= 1; }
    const_iterator operator++(int) { return std::exchange(*this, *this + 1); }
    const_iterator operator--(int) { return std::exchange(*this, *this - 1); }
    const_iterator& operator+=(difference_type n) {
      index_ += n;
      return *this;
    }
    const_iterator& operator-=(difference_type n) { return *this += -n; }
    friend const_iterator operator+(const_iterator it, difference_type n) { return it += n; }
    friend const_iterator operator+(difference_type n, const_iterator it) { return it += n; }
    friend const_iterator operator-(const_iterator it, difference_type n) { return it -= n; }
    friend difference_type operator-(const const_iterator& a, const const_iterator& b) { return a.index_ - b.index_; }
    friend bool operator==(const const_iterator& a, const const_iterator& b) { return a.index_ == b.index_; }
    friend auto operator<=>(const const_iterator& a, const const_iterator& b) { return a.index_ <=> b.index_; }

  private:
    const EventList* list_ = nullptr;
    difference_type index_ = 0;
  };

  EventList() = default;
  EventList(std::initializer_list<EventRecord> events) {
    for (const EventRecord& event : events)
      push_back(event);
  }

  void push_back(const EventRecord& event);
  void clear() { *this = EventList(); }

  bool empty() const { return size() == 0; }
  std::size_t size() const { return packed_.size(); }
  EventRecord operator[](std::size_t index) const;
  EventRecord front() const { return (*this)[0]; }
  EventRecord back() const { return (*this)[size() - 1]; }
  const_iterator begin() const { return {*this, 0}; }
  const_iterator end() const { return {*this, size()}; }

  /// Bytes of memory that `event` takes in a list.
  static std::size_t bytesOf(const EventRecord& event) { return sizeof(Packed) + event.text.size(); }

private:
  struct Packed {
    const char* text;
    double seconds;
    std::uint64_t line;
    std::uint32_t textSize, column, file, code;
    EventKind kind;
  };

  std::uint32_t nameIndex(const std::string& name);

  // Texts lie after each other in blocks that never move; copies of a list share those that are full.
  std::vector<std::shared_ptr<std::string>> blocks_;
  std::vector<std::string> names_;  ///< of files, and codes: few, each of many events
  std::unordered_map<std::string, std::uint32_t> nameIndices_;
  std::vector<Packed> packed_;
};

}  // namespace probewright::control
