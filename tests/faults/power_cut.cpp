#include "tests/faults/power_cut.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::faults {
namespace {

namespace fs = std::filesystem;

/// One call's change of a file.
struct DataChange {
  bool is_cut;           // else a write
  std::uint64_t offset;  // or the new size
  std::string bytes;
};

/// One call's change of a folder: what stands at these names, or nothing.
using NameChange = std::vector<std::pair<std::string, std::optional<int>>>;

using Names = std::map<std::string, int>;  // a node by its name

void apply(const DataChange& change, std::string& data) {
  if (change.is_cut) {
    data.resize(change.offset);
    return;
  }
  data.resize(std::max(data.size(), change.offset + change.bytes.size()));
  data.replace(change.offset, change.bytes.size(), change.bytes);
}

void apply(const NameChange& change, Names& names) {
  for (const auto& [name, node] : change) {
    names.erase(name);
    if (node) names.emplace(name, *node);
  }
}

/// A file or folder: as it was at its last fsync, and what was done since.
struct Node {
  bool is_folder = false;
  std::string data;
  Names names;
  std::vector<DataChange> data_since;
  std::vector<NameChange> names_since;

  void sync() {
    for (const DataChange& change : std::exchange(data_since, {})) apply(change, data);
    for (const NameChange& change : std::exchange(names_since, {})) apply(change, names);
  }
  /// As a program sees it.
  Names names_now() const {
    Names now = names;
    for (const NameChange& change : names_since) apply(change, now);
    return now;
  }
};

void zero_second_half(std::string& bytes) {
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2), bytes.end(), '\0');
}

template <class Change>
std::vector<Change> survivors(std::vector<Change> changes, Survives survives,
                              std::mt19937& random) {
  std::bernoulli_distribution coin;
  switch (survives) {
    case Survives::Nothing:
      return {};
    case Survives::Beginning:
      changes.resize(std::uniform_int_distribution<std::size_t>(0, changes.size())(random));
      break;
    case Survives::Any:
      std::erase_if(changes, [&](const Change&) { return coin(random); });
      break;
    case Survives::Torn:
      if constexpr (std::is_same_v<Change, DataChange>)
        if (!changes.empty()) zero_second_half(changes.back().bytes);
      break;
    case Survives::All:
      break;
  }
  return changes;
}

class Disk {
 public:
  Disk(const fs::path& before, fs::path folder) : folder_(std::move(folder)) { load(before); }

  void make(const Call& call) {
    using Kind = Call::Kind;
    switch (call.kind) {
      case Kind::Failed:
        return;
      case Kind::Open:
      case Kind::OpenEmpty:
        handles_[call.handle] = opened(call.path);
        if (call.kind == Kind::OpenEmpty) change(call.handle, {true, 0, ""});
        return;
      case Kind::Write:
        return change(call.handle, {false, call.offset, call.data});
      case Kind::Cut:
        return change(call.handle, {true, call.offset, ""});
      case Kind::Sync:
        return node(call.handle).sync();
      case Kind::Rename:
        return rename(call.path, call.to);
      case Kind::Remove:
        return put(call.path, std::nullopt);
      case Kind::MakeFolder:
        nodes_.emplace_back().is_folder = true;
        return put(call.path, static_cast<int>(nodes_.size()) - 1);
    }
  }

  void lose_power(const PowerCut& cut, std::mt19937& random) {
    for (Node& node : nodes_) {
      node.data_since = survivors(std::move(node.data_since), cut.data, random);
      node.names_since = survivors(std::move(node.names_since), cut.names, random);
      node.sync();
    }
  }

  void write(const fs::path& after, std::size_t from = 0) const {
    fs::create_directory(after);
    for (const auto& [name, index] : nodes_[from].names) {
      const auto i = static_cast<std::size_t>(index);
      if (nodes_[i].is_folder)
        write(after / name, i);
      else
        std::ofstream(after / name, std::ios::binary) << nodes_[i].data;
    }
  }

 private:
  int load(const fs::path& path) {
    const std::size_t i = nodes_.size();
    nodes_.emplace_back().is_folder = true;
    for (const auto& entry : fs::directory_iterator(path)) {
      int child = static_cast<int>(nodes_.size());
      if (entry.is_directory())
        child = load(entry.path());
      else
        nodes_.emplace_back().data = content(entry.path());
      nodes_[i].names[entry.path().filename().string()] = child;
    }
    return static_cast<int>(i);
  }

  std::optional<int> find(const fs::path& path) const {
    int at = 0;
    for (const fs::path& part : path.lexically_normal().lexically_relative(folder_)) {
      if (part == "." || part.empty()) continue;
      const Names names = nodes_[static_cast<std::size_t>(at)].names_now();
      const auto next = names.find(part.string());
      if (next == names.end()) return {};
      at = next->second;
    }
    return at;
  }

  Node& node(int handle) { return nodes_.at(static_cast<std::size_t>(handles_.at(handle))); }

  void change(int handle, const DataChange& change) { node(handle).data_since.push_back(change); }

  int existing(const fs::path& path) const {
    const auto found = find(path);
    if (!found)
      throw std::runtime_error("a call is about " + path.string() + ", which is not there");
    return *found;
  }

  void change_names(const fs::path& folder, const NameChange& change) {
    nodes_[static_cast<std::size_t>(existing(folder))].names_since.push_back(change);
  }

  void put(const fs::path& path, std::optional<int> node) {
    change_names(path.parent_path(), {{path.filename().string(), node}});
  }

  int opened(const fs::path& path) {
    if (const auto found = find(path)) return *found;
    nodes_.emplace_back();
    const int made = static_cast<int>(nodes_.size()) - 1;
    put(path, made);
    return made;
  }

  void rename(const fs::path& from, const fs::path& to) {
    if (from.parent_path() != to.parent_path())
      throw std::runtime_error("a rename from folder to folder is not modelled");
    change_names(from.parent_path(),
                 {{from.filename().string(), {}}, {to.filename().string(), existing(from)}});
  }

  fs::path folder_;
  std::vector<Node> nodes_;  // the first is the folder
  std::map<int, int> handles_;
};

}  // namespace

void cut_power(const fs::path& before, const fs::path& folder, std::span<const Call> calls,
               const PowerCut& cut, std::mt19937& random, const fs::path& after) {
  Disk disk(before, folder);
  for (const Call& call : calls) disk.make(call);
  disk.lose_power(cut, random);
  disk.write(after);
}

}  // namespace articular::faults
