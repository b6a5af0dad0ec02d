#include "simulation/step_records.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <unordered_map>

#include "base/text.hpp"

namespace probewright::simulation {
namespace {

bool isWordLetter(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

}  // namespace

/// Cuts a text where its tokens end; what it does not know ends it.
class StepRecords::Reader {
public:
  explicit Reader(StepRecords& result) : result_(result), text_(result.bytes_) {}

  bool read() {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (text_.starts_with(mark)) at_ = mark.size();
    if (!word("ISO-10303-21") || !sign(';') || !word("HEADER") || !sign(';')) return false;
    while (!word("ENDSEC")) {
      if (!part("#0") || !sign(';')) return false;
    }
    result_.header_ = result_.records_.size();
    if (!sign(';') || !word("DATA") || !sign(';')) return false;
    while (!word("ENDSEC")) {
      if (!entity() || !sign(';')) return false;
    }
    if (!sign(';') || !word("END-ISO-10303-21")) return false;
    endTokens();
    return true;
  }

private:
  struct Open {
    const char* name;
    const char* type;
    std::size_t first;  ///< of its arguments among those that wait
  };

  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  /// Goes over blanks and comments.
  void skip() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '/' && text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) return;
        at_ = end + 1;
      } else if (c != ' ' && c != '\n' && c != '\r' && c != '\t') {
        return;
      }
    }
  }

  bool sign(char c) {
    skip();
    if (next() != c) return false;
    ++at_;
    return true;
  }

  bool word(std::string_view wanted) {
    skip();
    if (text_.substr(at_, wanted.size()) != wanted) return false;
    const std::size_t end = at_ + wanted.size();
    if (end < text_.size() && isWordLetter(text_[end])) return false;
    at_ = end;
    return true;
  }

  /// The token from `begin` up to here, to be ended with 0 later.
  const char* token(std::size_t begin) {
    ends_.push_back(at_);
    return result_.bytes_.data() + begin;
  }

  /// A type; null if there is none.
  const char* type() {
    skip();
    if (!isLetter(next())) return nullptr;
    const std::size_t begin = at_;
    while (isWordLetter(next()))
      ++at_;
    return token(begin);
  }

  const char* listName(std::size_t number) {
    while (result_.listNames_.size() < number)
      result_.listNames_.push_back("$" + std::to_string(result_.listNames_.size() + 1));
    return result_.listNames_[number - 1].c_str();
  }

  bool entity() {
    skip();
    if (next() != '#') return false;
    const std::size_t begin = at_++;
    Entity entity;
    if (!number(entity.number) || entity.number == 0) return false;
    const char* const name = token(begin);
    entity.first = result_.records_.size();
    if (!sign('=')) return false;
    skip();
    const bool hasManyTypes = next() == '(';
    if (hasManyTypes) ++at_;
    if (!part(name)) return false;
    entity.head = result_.records_.size() - 1;
    while (hasManyTypes && !sign(')')) {
      if (!part("#0")) return false;
    }
    entity.last = result_.records_.size();
    result_.entities_.push_back(entity);
    return true;
  }

  bool number(std::uint64_t& value) {
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{}) return false;
    at_ = static_cast<std::size_t>(end - text_.data());
    return true;
  }

  /// A type with its list of arguments.
  bool part(const char* name) {
    const char* const own = type();
    if (own == nullptr || !sign('(')) return false;
    open_.assign(1, {name, own, 0});
    waiting_.clear();
    lists_ = 0;
    for (bool wantsArgument = true;;) {
      skip();
      if (next() == ')') {
        // Neither after a comma.
        if (wantsArgument && waiting_.size() > open_.back().first) return false;
        ++at_;
        close();
        if (open_.empty()) return true;
        wantsArgument = false;
      } else if (!wantsArgument) {
        if (next() != ',') return false;
        ++at_;
        wantsArgument = true;
        skip();
        if (next() == ')') return false;
      } else if (next() == '(' || isLetter(next())) {
        const char* const before = next() == '(' ? kList : type();
        if (!sign('(') || open_.size() > kDeepest) return false;
        open_.push_back({listName(++lists_), before, waiting_.size()});
      } else {
        if (!argument()) return false;
        wantsArgument = false;
      }
    }
  }

  void close() {
    const Open open = open_.back();
    open_.pop_back();
    const std::size_t first = result_.arguments_.size();
    result_.arguments_.insert(result_.arguments_.end(), waiting_.begin() + static_cast<std::ptrdiff_t>(open.first),
                              waiting_.end());
    result_.records_.push_back({open.name, open.type, first, waiting_.size() - open.first});
    waiting_.resize(open.first);
    if (!open_.empty()) waiting_.push_back({open.name, Kind::List});
  }

  bool argument() {
    const std::size_t begin = at_;
    const char first = next();
    Kind kind = Kind::Nothing;
    std::uint64_t entity = 0;
    switch (first) {
      case '#':
        ++at_;
        kind = Kind::Reference;
        if (!number(entity)) return false;
        break;
      case '\'':
        kind = Kind::Text;
        if (!restOfText()) return false;
        break;
      case '$':
      case '*':
        ++at_;
        kind = first == '$' ? Kind::Nothing : Kind::Derived;
        break;
      case '"':
        kind = Kind::Binary;
        at_ = text_.find('"', at_ + 1);
        if (at_ == std::string_view::npos) return false;
        ++at_;
        break;
      case '.':
        if (at_ + 1 < text_.size() && isLetter(text_[at_ + 1])) {
          kind = Kind::Enumeration;
          for (++at_; isWordLetter(next());)
            ++at_;
          if (next() != '.') return false;
          ++at_;
          break;
        }
        [[fallthrough]];
      default:
        if (!numeral(kind)) return false;
    }
    waiting_.push_back({token(begin), kind});
    return true;
  }

  /// Two apostrophes stand for one.
  bool restOfText() {
    for (++at_;; at_ += 2) {
      at_ = text_.find('\'', at_);
      if (at_ == std::string_view::npos) return false;
      if (at_ + 1 == text_.size() || text_[at_ + 1] != '\'') break;
    }
    ++at_;
    return true;
  }

  bool numeral(Kind& kind) {
    const auto digits = [&] {
      const std::size_t begin = at_;
      while (isDigit(next()))
        ++at_;
      return at_ - begin;
    };
    if (next() == '+' || next() == '-') ++at_;
    std::size_t count = digits();
    kind = Kind::Integer;
    if (next() == '.') {
      ++at_;
      count += digits();
      kind = Kind::Real;
      if (next() == 'E' || next() == 'e') {
        result_.bytes_[at_++] = 'E';
        if (next() == '+' || next() == '-') ++at_;
        if (digits() == 0) return false;
      }
    }
    return count > 0;
  }

  void endTokens() {
    for (const std::size_t end : ends_)
      result_.bytes_[end] = '\0';
  }

  static constexpr std::size_t kDeepest = 64;

  StepRecords& result_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::size_t> ends_;
  std::vector<Open> open_;
  std::vector<Argument> waiting_;  ///< of the lists that are open
  std::size_t lists_ = 0;          ///< in the record so far
};

std::optional<StepRecords> StepRecords::of(std::string bytes) {
  // It would end a token.
  if (bytes.find('\0') != std::string::npos) return std::nullopt;
  StepRecords records;
  records.bytes_ = std::move(bytes);
  if (!Reader(records).read()) return std::nullopt;
  return records;
}

std::vector<std::size_t> StepRecords::referencesOf(const Entity& entity) const {
  std::vector<std::size_t> numbers;
  for (std::size_t r = entity.first; r < entity.last; ++r) {
    const Record& record = records_[r];
    for (std::size_t a = record.first; a < record.first + record.count; ++a) {
      if (arguments_[a].kind != Kind::Reference) continue;
      const std::string_view text = arguments_[a].text;
      std::size_t number = 0;
      std::from_chars(text.data() + 1, text.data() + text.size(), number);
      numbers.push_back(number);
    }
  }
  return numbers;
}

void StepRecords::joinShapes() {
  constexpr std::string_view kRelationship = "MECHANICAL_DESIGN_AND_DRAUGHTING_RELATIONSHIP";
  std::unordered_map<std::size_t, std::string_view> typeOf;
  std::unordered_map<std::size_t, int> users;
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> relationships;
  for (const Entity& entity : entities_) {
    typeOf.emplace(entity.number, records_[entity.head].type);
    const std::vector<std::size_t> references = referencesOf(entity);
    for (const std::size_t number : references)
      ++users[number];
    if (records_[entity.head].type == kRelationship && references.size() == 2)
      relationships.emplace_back(entity.head, references);
  }
  for (const auto& [head, ends] : relationships) {
    const auto isShape = [&](std::size_t number) { return typeOf[number].ends_with("SHAPE_REPRESENTATION"); };
    const auto isAlone = [&](std::size_t number) { return users[number] == 1; };
    if (std::ranges::all_of(ends, isShape) && std::ranges::any_of(ends, isAlone))
      records_[head].type = "SHAPE_REPRESENTATION_RELATIONSHIP";
  }
}

void StepRecords::dropAnnotations() {
  static constexpr std::string_view kDrawing = "DRAUGHTING_MODEL";
  constexpr std::array<std::string_view, 11> kAbout{"DRAUGHTING_MODEL_ITEM_ASSOCIATION",
                                                    "GEOMETRIC_ITEM_SPECIFIC_USAGE",
                                                    "ID_ATTRIBUTE",
                                                    "INVISIBILITY",
                                                    "MECHANICAL_DESIGN_AND_DRAUGHTING_RELATIONSHIP",
                                                    "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION",
                                                    "OVER_RIDING_STYLED_ITEM",
                                                    "PRESENTATION_LAYER_ASSIGNMENT",
                                                    "PRESENTATION_STYLE_ASSIGNMENT",
                                                    "STYLED_ITEM",
                                                    "TESSELLATED_ANNOTATION_OCCURRENCE"};
  std::unordered_map<std::size_t, std::size_t> placeOf;
  placeOf.reserve(entities_.size());
  for (std::size_t i = 0; i < entities_.size(); ++i)
    placeOf.emplace(entities_[i].number, i);
  std::vector<std::vector<std::size_t>> references(entities_.size());
  std::vector<bool> isReferredTo(entities_.size()), isKept(entities_.size());
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    for (const std::size_t number : referencesOf(entities_[i])) {
      const auto found = placeOf.find(number);
      if (found == placeOf.end()) continue;
      references[i].push_back(found->second);
      isReferredTo[found->second] = true;
    }
  }
  const auto isDrawing = [&](std::size_t i) {
    const auto types = std::span(records_).subspan(entities_[i].head, entities_[i].last - entities_[i].head);
    return std::ranges::any_of(types, [](const Record& record) { return record.type == kDrawing; });
  };
  const auto isAbout = [&](std::size_t i) {
    const std::string_view type = records_[entities_[i].head].type;
    if (std::ranges::find(kAbout, type) != kAbout.end() || isDrawing(i)) return true;
    // Between a shape and its drawing; not one that is more than that.
    return type == "REPRESENTATION_RELATIONSHIP" && entities_[i].last == entities_[i].head + 1 &&
           std::ranges::any_of(references[i], isDrawing);
  };
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    if (isReferredTo[i] || isAbout(i)) continue;
    isKept[i] = true;
    open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (const std::size_t to : references[i]) {
      if (isKept[to]) continue;
      isKept[to] = true;
      open.push_back(to);
    }
  }
  std::vector<Record> kept(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(header_));
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    if (!isKept[i]) continue;
    kept.insert(kept.end(), records_.begin() + static_cast<std::ptrdiff_t>(entities_[i].first),
                records_.begin() + static_cast<std::ptrdiff_t>(entities_[i].last));
  }
  records_ = std::move(kept);
  entities_.clear();
}

}  // namespace probewright::simulation
