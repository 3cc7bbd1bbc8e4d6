#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "lib/config/yaml_document.h"

namespace orthodyn {

namespace {

// Placeholder for invalid UTF-8, which is inserted after emission because the emitter would repair it.
constexpr const char* kNoUtf8 = "NO_UTF8";

const std::vector<std::string>& edge_values() {
  static const std::vector<std::string> all{"",
                                            "0",
                                            "-0",
                                            "-1",
                                            "1",
                                            "2",
                                            "3",
                                            "0.5",
                                            "1e-320",
                                            "1e-300",
                                            "-1e-300",
                                            "1e-12",
                                            "1e12",
                                            "1e150",
                                            "1e300",
                                            "-1e300",
                                            "1e308",
                                            "1e400",
                                            "1e9",
                                            "1e6",
                                            "2147483647",
                                            "2147483648",
                                            "-2147483649",
                                            "9223372036854775808",
                                            "nan",
                                            ".nan",
                                            "inf",
                                            ".inf",
                                            "-.inf",
                                            "true",
                                            "no",
                                            "~",
                                            "null",
                                            "1,5",
                                            "1e",
                                            "0x10",
                                            "--1",
                                            "1 m",
                                            "-3 mm",
                                            "1 kg",
                                            "20 deg",
                                            "1 GPa",
                                            "1e400 m",
                                            "3 s",
                                            "5 K",
                                            "1 m/",
                                            "m",
                                            "=",
                                            "=1/0",
                                            "=t",
                                            "1/0",
                                            "sqrt(-1-t)",
                                            "t^t^t",
                                            "exp(1e3*t)",
                                            "x",
                                            "x0",
                                            "all",
                                            "auto",
                                            "none",
                                            "body",
                                            "zero",
                                            ".",
                                            "..",
                                            "/",
                                            "/dev/null",
                                            "/nowhere/a.yaml",
                                            "*",
                                            "&a",
                                            "!x",
                                            "%",
                                            "<<",
                                            "include",
                                            "\"",
                                            "'",
                                            "#",
                                            "{",
                                            "[",
                                            "]",
                                            ": ",
                                            "- ",
                                            "a,b",
                                            "a\nb",
                                            "\t",
                                            " ",
                                            "\x01",
                                            "\xC3\xBC",
                                            kNoUtf8,
                                            std::string(5000, 'a'),
                                            std::string(400, '('),
                                            std::string(300, '-'),
                                            std::string(200, '9'),
                                            std::string(100, '[') + std::string(100, ']')};
  return all;
}

template <class List>
const auto& one_of(const List& list, std::mt19937& random) {
  return list[random() % list.size()];
}

// A value below the root, with its parent and its key.
struct Slot {
  YAML::Node parent, key, value;  // in a list the key is the index
};

void collect(const YAML::Node& node, std::vector<Slot>& slots, int depth = 0) {
  if (depth > 60) return;
  if (node.IsMap())
    for (const auto& entry : node)
      slots.push_back({node, entry.first, entry.second}), collect(entry.second, slots, depth + 1);
  if (node.IsSequence())
    for (std::size_t i = 0; i < node.size(); ++i)
      slots.push_back({node, YAML::Node(i), node[i]}), collect(node[i], slots, depth + 1);
}

YAML::Node list_of(const YAML::Node& item, std::size_t count) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (std::size_t i = 0; i < count; ++i) list.push_back(YAML::Clone(item));
  return list;
}

YAML::Node nested(YAML::Node node, std::size_t depth, bool in_lists) {
  for (std::size_t i = 0; i < depth; ++i) {
    YAML::Node outer;
    if (in_lists) outer.push_back(node);
    else outer["a"] = node;
    node.reset(outer);
  }
  return node;
}

class TreeMutation {
 public:
  TreeMutation(YAML::Node root, const std::vector<std::string>& words, std::mt19937& random)
      : root_(std::move(root)), words_(words), random_(random) {}

  void change() {
    slots_.clear();
    collect(root_, slots_);
    if (slots_.empty()) return put(root_, YAML::Node(one_of(edge_values(), random_)));
    Slot& slot = slots_[random_() % slots_.size()];
    switch (random_() % 16) {
      case 0: return lose(slot);
      case 1: return double_key(slot);
      case 2: return rename(slot);
      case 3: return exchange(slot, slots_[random_() % slots_.size()]);
      case 4: return put(slot.value, YAML::Clone(slots_[random_() % slots_.size()].value));
      case 5: return put(slot.value, list_of(slot.value, random_() % 5));
      case 6: return put(slot.value, nested(YAML::Clone(slot.value), 1 + random_() % 3, random_() % 2 == 0));
      case 7:
        return random_() % 4 == 0
                   ? put(slot.value, nested(YAML::Clone(slot.value), 90 + random_() % 20, random_() % 2))
                   : put(slot.value, YAML::Node(random_() % 2 ? YAML::NodeType::Map : YAML::NodeType::Null));
      case 8: return add_key(slot);
      case 9:
      case 10: return put(scalar_slot().value, YAML::Node(words_.empty() ? "" : one_of(words_, random_)));
      default: return put(scalar_slot().value, YAML::Node(edge_of(scalar_slot().value)));
    }
  }

  std::string text() const {
    YAML::Emitter out;
    out << root_;
    return std::string(out.c_str()) + "\n";
  }

 private:
  // `into` is taken by value: assigning to a copy of a YAML::Node changes the node in the tree.
  static void put(YAML::Node into, const YAML::Node& value) { into = value; }

  const Slot& scalar_slot() {
    for (int tries = 0; tries < 20; ++tries)
      if (const Slot& slot = slots_[random_() % slots_.size()]; slot.value.IsScalar()) return slot;
    return slots_.front();
  }

  // One of edge_values(), or the present value with an added sign, digits, exponent or unit.
  std::string edge_of(const YAML::Node& value) {
    if (!value.IsScalar() || random_() % 3 != 0) return one_of(edge_values(), random_);
    static constexpr std::array<const char*, 14> kBefore{"-", "-", "", "", "", "", "", "", "", "", "", "", "0.", "1"};
    static constexpr std::array<const char*, 14> kAfter{"",   " m", "e3", "e-3", "e30",   "e-30", "e200",
                                                        " s", " %", "_",  " Pa", "e-200", "",     ""};
    const std::size_t k = random_() % kBefore.size();
    return kBefore[k] + value.Scalar() + kAfter[random_() % kAfter.size()];
  }

  static void lose(Slot& slot) {
    if (slot.parent.IsMap()) slot.parent.remove(slot.key);
    else slot.parent.remove(slot.key.as<std::size_t>());
  }

  void double_key(Slot& slot) {
    if (slot.parent.IsMap())
      slot.parent.force_insert(slot.key.Scalar(), YAML::Clone(slots_[random_() % slots_.size()].value));
    else slot.parent.push_back(YAML::Clone(slot.value));
  }

  std::string other_key(const std::string& key) {
    if (!words_.empty() && random_() % 2 == 0) return one_of(words_, random_);
    if (random_() % 2 == 0) return one_of(edge_values(), random_);
    return with_mutated_bytes(key, random_);
  }

  void rename(Slot& slot) {
    if (!slot.parent.IsMap()) return lose(slot);
    const YAML::Node value = YAML::Clone(slot.value);
    const std::string key = slot.key.Scalar();
    slot.parent.remove(key);
    slot.parent.force_insert(other_key(key), value);
  }

  void add_key(Slot& slot) {
    YAML::Node map = slot.value.IsMap() ? slot.value : slot.parent;
    if (map.IsMap()) map.force_insert(other_key("key"), YAML::Clone(slots_[random_() % slots_.size()].value));
    else map.push_back(YAML::Clone(slots_[random_() % slots_.size()].value));
  }

  static void exchange(Slot& a, Slot& b) {
    const YAML::Node first = YAML::Clone(a.value), second = YAML::Clone(b.value);
    put(a.value, second);
    put(b.value, first);
  }

  YAML::Node root_;
  const std::vector<std::string>& words_;
  std::mt19937& random_;
  std::vector<Slot> slots_;
};

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

void collect_words(const YAML::Node& root, std::vector<std::string>& words) {
  std::vector<Slot> slots;
  collect(root, slots);
  for (const auto& slot : slots) {
    if (slot.parent.IsMap()) words.push_back(slot.key.Scalar());
    if (slot.value.IsScalar() && slot.value.Scalar().size() < 100) words.push_back(slot.value.Scalar());
  }
}

}  // namespace

std::string with_mutated_bytes(std::string text, std::mt19937& random) {
  const std::string meaningful = "0123456789-+.eE$*,#<>_= \n\r\t\"";
  for (std::size_t changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
    const std::size_t at = random() % text.size();
    switch (random() % 6) {
      case 0: text[at] = static_cast<char>(random() % 256); break;
      case 1: text[at] = meaningful[random() % meaningful.size()]; break;
      case 2: text.insert(at, 1, meaningful[random() % meaningful.size()]); break;
      case 3: text.erase(at, 1 + random() % 8); break;
      case 4: text.insert(at, text.substr(random() % text.size(), random() % 40)); break;
      default:
        if (random() % 4 == 0) text.resize(at);
    }
  }
  return text;
}

std::string with_mutated_tree(const std::string& yaml, const std::vector<std::string>& words, std::mt19937& random) {
  try {
    TreeMutation mutation(YAML::Load(yaml), words, random);
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) mutation.change();
    std::string text = mutation.text();
    replace_all(text, kNoUtf8, "\xFF\xC0");
    return text;
  } catch (const YAML::Exception&) {
    return with_mutated_bytes(yaml, random);
  }
}

std::vector<std::string> words_of(const std::string& yaml) {
  std::vector<std::string> words;
  try {
    collect_words(YAML::Load(yaml), words);
  } catch (const YAML::Exception&) {
  }
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace orthodyn
