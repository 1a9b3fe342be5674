#include "io/calibration/pickle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"

namespace walktrack {
inline namespace io {

namespace {

enum class Kind { kNone, kNumber, kText, kBytes, kList, kTuple, kDict, kGlobal, kObject, kMark };

// Values refer to each other by their index in one list, so that cycles do no harm.
struct Value {
  Kind kind = Kind::kNone;
  double number = 0;
  std::string text{};           // of texts and bytes; for a global, "module name"
  std::vector<size_t> items{};  // of containers; of a dict, keys and values in turn; of an object,
                                // the global and its arguments, then the state if there is one
};

constexpr const char* kAllowed = "a dictionary of numpy arrays, as OpenCap writes it";

// Whether numpy's arrays are constructed by this global.
bool is_numpy(const std::string& global) {
  constexpr std::string_view kNames[] = {"numpy.core.multiarray _reconstruct",
                                         "numpy._core.multiarray _reconstruct",
                                         "numpy.core.multiarray scalar",
                                         "numpy._core.multiarray scalar",
                                         "numpy.core.numeric _frombuffer",
                                         "numpy._core.numeric _frombuffer",
                                         "numpy ndarray",
                                         "numpy dtype",
                                         "_codecs encode"};
  return std::find(std::begin(kNames), std::end(kNames), global) != std::end(kNames);
}

class Machine {
 public:
  Machine(const std::string& bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  // Runs the program and returns the index of the resulting value.
  size_t run();
  const Value& at(size_t index) const { return values_[index]; }

  [[noreturn]] void fail(std::string_view found, std::string_view allowed = kAllowed) const {
    throw InputError(describe({file_, 0, fmt::format("byte {}", op_at_)}, found, allowed));
  }

 private:
  uint8_t byte() {
    if (next_ >= bytes_.size()) fail("the end of the file inside of a value");
    return static_cast<uint8_t>(bytes_[next_++]);
  }
  // A little-endian integer of up to eight bytes.
  uint64_t whole(int size) {
    uint64_t out = 0;
    for (int i = 0; i < size; ++i) out |= uint64_t{byte()} << (8 * i);
    return out;
  }
  std::string take(uint64_t length) {
    if (length > bytes_.size() - next_) fail("the end of the file inside of a text");
    next_ += length;
    return bytes_.substr(next_ - length, length);
  }
  std::string line() {
    const size_t end = bytes_.find('\n', next_);
    if (end == std::string::npos) fail("the end of the file inside of a name");
    std::string out = bytes_.substr(next_, end - next_);
    next_ = end + 1;
    return out;
  }

  size_t add(Value value) {
    values_.push_back(std::move(value));
    return values_.size() - 1;
  }
  void push(Value value) { stack_.push_back(add(std::move(value))); }
  void push_number(double number) { push({Kind::kNumber, number}); }
  void push_text(Kind kind, std::string text) { push({kind, 0, std::move(text)}); }
  size_t pop() {
    if (stack_.empty() || values_[stack_.back()].kind == Kind::kMark) fail("a value missing");
    const size_t out = stack_.back();
    stack_.pop_back();
    return out;
  }
  Value& top(Kind kind) {
    if (stack_.empty() || values_[stack_.back()].kind != kind) fail("a container missing");
    return values_[stack_.back()];
  }
  std::vector<size_t> pop_to_mark() {
    size_t from = stack_.size();
    while (from > 0 && values_[stack_[from - 1]].kind != Kind::kMark) --from;
    if (from == 0) fail("a mark missing");
    std::vector<size_t> out(stack_.begin() + static_cast<std::ptrdiff_t>(from), stack_.end());
    stack_.resize(from - 1);
    return out;
  }
  void append(Kind kind, const std::vector<size_t>& items) {
    if (kind == Kind::kDict && items.size() % 2 != 0) fail("a key without a value");
    std::vector<size_t>& all = top(kind).items;
    all.insert(all.end(), items.begin(), items.end());
  }
  void push_tuple(size_t count) {
    std::vector<size_t> items(count);
    for (size_t i = count; i-- > 0;) items[i] = pop();
    push({Kind::kTuple, 0, "", std::move(items)});
  }
  void push_global(const std::string& module, const std::string& name) {
    const std::string global = module + " " + name;
    if (!is_numpy(global)) fail(fmt::format("'{}.{}'", module, name));
    push_text(Kind::kGlobal, global);
  }
  void remember(uint64_t key) {
    if (stack_.empty()) fail("nothing to remember");
    memo_[key] = stack_.back();
  }
  void recall(uint64_t key) {
    const auto found = memo_.find(key);
    if (found == memo_.end()) fail("a value that was never remembered");
    stack_.push_back(found->second);
  }
  // Records the call of a global with its arguments; nothing is called.
  void note_call() {
    const size_t arguments = pop(), callable = pop();
    if (values_[callable].kind != Kind::kGlobal || values_[arguments].kind != Kind::kTuple)
      fail("a call of something else than a function");
    push({Kind::kObject, 0, "", {callable, arguments}});
  }
  void note_state() {
    const size_t state = pop();
    Value& object = top(Kind::kObject);
    if (object.items.size() != 2) fail("a second state");
    object.items.push_back(state);
  }
  double big_endian_double() {
    uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    return std::bit_cast<double>(bits);
  }
  void long_number() {
    const int size = byte();
    if (size > 8) fail("a number of more than 64 bits");
    const uint64_t bits = whole(size);
    const bool negative = size > 0 && (bits >> (8 * size - 1) & 1) != 0;
    const uint64_t all = negative && size < 8 ? bits | ~uint64_t{0} << (8 * size) : bits;
    push_number(static_cast<double>(static_cast<int64_t>(all)));
  }
  // Returns false at the end of the program.
  bool step(uint8_t op);
  bool step_container(uint8_t op);
  bool step_memory(uint8_t op);

  const std::string& bytes_;
  const std::string& file_;
  size_t next_ = 0, op_at_ = 0;
  std::vector<Value> values_;
  std::vector<size_t> stack_;
  std::map<uint64_t, size_t> memo_;
};

// Opcodes of values. Opcodes of containers are passed on.
bool Machine::step(uint8_t op) {
  switch (op) {
    case 0x80:
      byte();
      return true;  // PROTO
    case 0x95:
      whole(8);
      return true;  // FRAME
    case 'N':
      push({});
      return true;  // NONE
    case 0x88:
      push_number(1);
      return true;  // NEWTRUE
    case 0x89:
      push_number(0);
      return true;  // NEWFALSE
    case 'J':
      push_number(static_cast<int32_t>(whole(4)));
      return true;  // BININT
    case 'K':
      push_number(byte());
      return true;  // BININT1
    case 'M':
      push_number(static_cast<double>(whole(2)));
      return true;  // BININT2
    case 0x8a:
      long_number();
      return true;  // LONG1
    case 'G':
      push_number(big_endian_double());
      return true;  // BINFLOAT
    case 'X':
      push_text(Kind::kText, take(whole(4)));
      return true;  // BINUNICODE
    case 0x8c:
      push_text(Kind::kText, take(byte()));
      return true;  // SHORT_BINUNICODE
    case 0x8d:
      push_text(Kind::kText, take(whole(8)));
      return true;  // BINUNICODE8
    case 'T':
      push_text(Kind::kBytes, take(whole(4)));
      return true;  // BINSTRING
    case 'U':
      push_text(Kind::kBytes, take(byte()));
      return true;  // SHORT_BINSTRING
    case 'B':
      push_text(Kind::kBytes, take(whole(4)));
      return true;  // BINBYTES
    case 'C':
      push_text(Kind::kBytes, take(byte()));
      return true;  // SHORT_BINBYTES
    case 0x8e:      // BINBYTES8
    case 0x96:
      push_text(Kind::kBytes, take(whole(8)));
      return true;  // BYTEARRAY8
    default:
      return step_container(op);
  }
}

// Opcodes of containers and their items.
bool Machine::step_container(uint8_t op) {
  switch (op) {
    case '}':
      push({Kind::kDict});
      return true;  // EMPTY_DICT
    case ']':
      push({Kind::kList});
      return true;  // EMPTY_LIST
    case ')':
      push({Kind::kTuple});
      return true;  // EMPTY_TUPLE
    case '(':
      push({Kind::kMark});
      return true;  // MARK
    case 't':
      push({Kind::kTuple, 0, "", pop_to_mark()});
      return true;  // TUPLE
    case 0x85:      // TUPLE1
    case 0x86:      // TUPLE2
    case 0x87:      // TUPLE3
      push_tuple(op - 0x84);
      return true;
    case 'a': {  // APPEND
      const size_t item = pop();
      append(Kind::kList, {item});
      return true;
    }
    case 'e':
      append(Kind::kList, pop_to_mark());
      return true;  // APPENDS
    case 's': {     // SETITEM
      const size_t value = pop(), key = pop();
      append(Kind::kDict, {key, value});
      return true;
    }
    case 'u':
      append(Kind::kDict, pop_to_mark());
      return true;  // SETITEMS
    default:
      return step_memory(op);
  }
}

// Opcodes that refer to earlier values: the memo, and classes and calls of the program that wrote
// the file, none of which is executed.
bool Machine::step_memory(uint8_t op) {
  switch (op) {
    case 'q':
      remember(byte());
      return true;  // BINPUT
    case 'r':
      remember(whole(4));
      return true;  // LONG_BINPUT
    case 0x94:
      remember(memo_.size());
      return true;  // MEMOIZE
    case 'h':
      recall(byte());
      return true;  // BINGET
    case 'j':
      recall(whole(4));
      return true;  // LONG_BINGET
    case 'c': {     // GLOBAL
      const std::string module = line();
      push_global(module, line());
      return true;
    }
    case 0x93: {  // STACK_GLOBAL
      const size_t name = pop(), module = pop();
      push_global(values_[module].text, values_[name].text);
      return true;
    }
    case 'R':
      note_call();
      return true;  // REDUCE
    case 'b':
      note_state();
      return true;  // BUILD
    case '.':
      return false;  // STOP
    default:
      fail(fmt::format("opcode 0x{:02x}", op));
  }
}

size_t Machine::run() {
  do {
    op_at_ = next_;
  } while (step(byte()));
  return pop();
}

// The number type of an array.
struct Layout {
  char kind;  // f, i, u or b
  size_t size;
  bool big_endian;
};

class Arrays {
 public:
  explicit Arrays(const Machine& machine) : machine_(machine) {}
  // nullopt if the value is not an array.
  std::optional<PickledArray> array(size_t index);

 private:
  // The items of a tuple or object that has at least so many of them.
  const std::vector<size_t>& items(size_t index, Kind kind, size_t least) const {
    const Value& value = machine_.at(index);
    if (value.kind != kind || value.items.size() < least) machine_.fail("an incomplete array");
    return value.items;
  }
  const std::string& text(size_t index) const { return machine_.at(index).text; }
  std::string raw(size_t index) const;
  Layout layout(size_t index) const;
  std::vector<size_t> shape(size_t index) const;
  PickledArray made(const std::vector<size_t>& shape, const Layout& layout,
                    const std::string& bytes, bool by_columns);
  double number(const std::string& bytes, size_t at, const Layout& layout) const;

  const Machine& machine_;
  size_t total_ = 0;  // numbers returned so far: a file may refer to one array many times
};

// The bytes themselves; in protocol 2 they are written as _codecs.encode(text, "latin1").
std::string Arrays::raw(size_t index) const {
  const Value& value = machine_.at(index);
  if (value.kind == Kind::kBytes) return value.text;
  const std::vector<size_t>& call = items(index, Kind::kObject, 2);
  if (text(call[0]) != "_codecs encode") machine_.fail("an array without bytes");
  const std::string& coded = text(items(call[1], Kind::kTuple, 1)[0]);  // UTF-8
  std::string out;
  for (size_t i = 0; i < coded.size(); ++i) {
    const auto lead = static_cast<uint8_t>(coded[i]);
    if (lead < 0x80) {
      out += coded[i];
    } else if ((lead == 0xc2 || lead == 0xc3) && i + 1 < coded.size()) {
      out += static_cast<char>((lead & 3) << 6 | (static_cast<uint8_t>(coded[++i]) & 0x3f));
    } else {
      machine_.fail("an array without bytes");
    }
  }
  return out;
}

Layout Arrays::layout(size_t index) const {
  const std::vector<size_t>& made = items(index, Kind::kObject, 2);
  if (text(made[0]) != "numpy dtype") machine_.fail("an array of no type");
  const std::string& name = text(items(made[1], Kind::kTuple, 1)[0]);
  const bool big = made.size() > 2 && text(items(made[2], Kind::kTuple, 2)[1]) == ">";
  for (const std::string_view known : {"f8", "f4", "i8", "i4", "i2", "i1", "u8", "u4", "u2", "u1"})
    if (name == known) return {name[0], static_cast<size_t>(name[1] - '0'), big};
  machine_.fail(fmt::format("an array of type '{}'", name), "numbers");
}

std::vector<size_t> Arrays::shape(size_t index) const {
  std::vector<size_t> out;
  for (const size_t each : items(index, Kind::kTuple, 0)) {
    const Value& side = machine_.at(each);
    if (side.kind != Kind::kNumber || !(side.number >= 0 && side.number <= kMostPickleBytes))
      machine_.fail("an array of no size");
    out.push_back(static_cast<size_t>(side.number));
  }
  return out;
}

double Arrays::number(const std::string& bytes, size_t at, const Layout& layout) const {
  uint64_t bits = 0;
  for (size_t i = 0; i < layout.size; ++i) {
    const auto byte =
        static_cast<uint8_t>(bytes[at + (layout.big_endian ? layout.size - 1 - i : i)]);
    bits |= uint64_t{byte} << (8 * i);
  }
  if (layout.kind == 'f')
    return layout.size == 8 ? std::bit_cast<double>(bits)
                            : std::bit_cast<float>(static_cast<uint32_t>(bits));
  if (layout.kind == 'u') return static_cast<double>(bits);
  const size_t unused = 8 * (8 - layout.size);
  return static_cast<double>(static_cast<int64_t>(bits << unused) >> unused);
}

PickledArray Arrays::made(const std::vector<size_t>& shape, const Layout& layout,
                          const std::string& bytes, bool by_columns) {
  size_t count = 1;
  for (const size_t side : shape) {
    count *= side;
    if (count > kMostPickleBytes) machine_.fail("an array larger than the file");
  }
  total_ += count;
  if (total_ > kMostPickleBytes) machine_.fail("more numbers than the file is long");
  if (bytes.size() != count * layout.size) machine_.fail("an array that is not as long as it says");
  PickledArray out{shape, {}};
  for (size_t k = 0; k < count; ++k) {
    size_t at = k;
    if (by_columns && shape.size() == 2) at = (k % shape[1]) * shape[0] + k / shape[1];
    out.numbers.push_back(number(bytes, at * layout.size, layout));
  }
  return out;
}

std::optional<PickledArray> Arrays::array(size_t index) {
  const Value& value = machine_.at(index);
  if (value.kind != Kind::kObject) return std::nullopt;
  const std::string& maker = text(value.items[0]);
  if (maker.ends_with("_reconstruct")) {  // state: version, shape, type, column order, bytes
    const auto& state = items(items(index, Kind::kObject, 3)[2], Kind::kTuple, 5);
    return made(shape(state[1]), layout(state[2]), raw(state[4]),
                machine_.at(state[3]).number != 0);
  }
  if (maker.ends_with("_frombuffer")) {  // bytes, type, shape, order
    const auto& call = items(value.items[1], Kind::kTuple, 4);
    return made(shape(call[2]), layout(call[1]), raw(call[0]), text(call[3]) == "F");
  }
  if (maker.ends_with("scalar")) {  // type, bytes
    const auto& call = items(value.items[1], Kind::kTuple, 2);
    return made({}, layout(call[0]), raw(call[1]), false);
  }
  return std::nullopt;
}

}  // namespace

std::map<std::string, PickledArray> read_pickled_arrays(const std::string& bytes,
                                                        const std::string& file) {
  if (bytes.size() > kMostPickleBytes)
    throw InputError(describe({file, 0, ""}, fmt::format("{} bytes", bytes.size()),
                              fmt::format("at most {} of a calibration", kMostPickleBytes)));
  Machine machine(bytes, file);
  const size_t root = machine.run();
  if (machine.at(root).kind != Kind::kDict) machine.fail("no dictionary");
  Arrays arrays(machine);
  std::map<std::string, PickledArray> out;
  const std::vector<size_t>& items = machine.at(root).items;
  for (size_t i = 0; i + 1 < items.size(); i += 2) {
    if (machine.at(items[i]).kind != Kind::kText) continue;
    if (auto array = arrays.array(items[i + 1]))
      out.insert_or_assign(machine.at(items[i]).text, std::move(*array));
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
