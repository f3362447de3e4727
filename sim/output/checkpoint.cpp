#include "sim/output/checkpoint.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/hash.hpp"

namespace articular::sim {
namespace {

constexpr char kMagic[] = "articular checkpoint 16\n";

constexpr const char *kNewest = "state.bin", *kBefore = "previous.bin";

template <class T>
void put(const T& value, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void put_vector(const Eigen::VectorXd& values, std::string& bytes) {
  put(values.size(), bytes);
  bytes.append(reinterpret_cast<const char*>(values.data()),
               static_cast<std::size_t>(values.size()) * sizeof(double));
}

/// The file ends too early or is no checkpoint.
struct Torn {};

/// Takes values off the front of a file's bytes.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
  }
  void get_vector(Eigen::VectorXd& values) {
    Eigen::Index size = 0;
    get(size);
    if (size < 0 || static_cast<std::size_t>(size) > rest_.size() / sizeof(double)) throw Torn{};
    const auto doubles = take(static_cast<std::size_t>(size) * sizeof(double));
    values.resize(size);
    if (size > 0) std::memcpy(values.data(), doubles.data(), doubles.size());
  }
  std::string_view take(std::size_t size) {
    if (rest_.size() < size) throw Torn{};
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }

 private:
  std::string_view rest_;
};

/// Members one by one, to be written or read: the bytes between members of different sizes are
/// anything, and equal states are to give equal files.
template <class Overlap, class Visit>
void each_of_overlap(Overlap& overlap, const Visit& visit) {
  visit(overlap.contact);
  visit(overlap.before);
  visit(overlap.after);
}

template <class AnyCrossing, class Visit>
void each_of_crossing(AnyCrossing& crossing, const Visit& visit) {
  visit(crossing.surface);
  visit(crossing.edge);
  visit(crossing.forward);
  visit(crossing.t);
}

template <class Worst, class Visit>
void each_of_worst(Worst& worst, const Visit& visit) {
  visit(worst.value);
  visit(worst.of);
  visit(worst.at);
}

template <class AnySnap, class Visit>
void each_of_snap(AnySnap& snap, const Visit& visit) {
  visit(snap.body);
  visit(snap.at);
  visit(snap.motion);
  visit(snap.expected);
  visit(snap.loss);
}

template <class AnyVolume, class Visit>
void each_of_volume(AnyVolume& volume, const Visit& visit) {
  visit(volume.ratio);
  visit(volume.tissue);
  visit(volume.element);
  visit(volume.at);
}

template <class Extrema, class Visit>
void each_of_extrema(Extrema& extrema, const Visit& visit) {
  each_of_volume(extrema.least, visit);
  each_of_volume(extrema.largest, visit);
  each_of_worst(extrema.overlap, visit);
  each_of_worst(extrema.layer, visit);
  each_of_worst(extrema.driven, visit);
  each_of_worst(extrema.strain, visit);
  each_of_snap(extrema.snap, visit);
  visit(extrema.kinetic);
  visit(extrema.work);
  visit(extrema.moved_at);
  visit(extrema.made);
  visit(extrema.gravity_low);
  visit(extrema.gravity_high);
}

/// All of it but the state's vector, each in its place, to be written or read.
template <class AnyCheckpoint, class Visit>
void each_of_checkpoint(AnyCheckpoint& checkpoint, const Visit& visit) {
  auto& state = checkpoint.state;
  visit(state.t);
  visit(state.next_step);
  visit(state.next_margin);
  visit(state.max_penetration);
  visit(state.frames);
  visit(state.energy);
  visit(state.counts);
  each_of_extrema(state.extrema, visit);
  visit(state.overlap_resolution.solutions);
  visit(state.overlap_resolution.iterations);
  visit(state.overlap_resolution.largest_motion);
  for (auto* extent : {&checkpoint.history, &checkpoint.series, &checkpoint.convergence}) {
    visit(extent->bytes);
    visit(extent->hash);
  }
}

/// @throws Torn, or InputError when it belongs to another scenario
Checkpoint parsed(const std::string& bytes, const std::string& fingerprint,
                  const std::filesystem::path& file) {
  if (bytes.size() < sizeof(std::uint64_t)) throw Torn{};
  const std::size_t body = bytes.size() - sizeof(std::uint64_t);
  std::uint64_t stored = 0;
  std::memcpy(&stored, bytes.data() + body, sizeof(stored));
  if (stored != hash_bytes(std::string_view(bytes).substr(0, body))) throw Torn{};
  ByteReader reader(std::string_view(bytes).substr(0, body));
  if (reader.take(std::strlen(kMagic)) != kMagic) throw Torn{};
  if (reader.take(fingerprint.size()) != fingerprint)
    throw InputError(
        fmt::format("{} belongs to another scenario, mesh or setting; run without "
                    "--resume or choose another --out",
                    file.string()));
  Checkpoint checkpoint;
  const auto get_member = [&](auto& member) { reader.get(member); };
  each_of_checkpoint(checkpoint, get_member);
  std::size_t num_overlaps = 0;
  reader.get(num_overlaps);
  for (std::size_t k = 0; k < num_overlaps; ++k)
    each_of_overlap(checkpoint.state.overlap_resolution.overlaps.emplace_back(), get_member);
  reader.get_vector(checkpoint.state.y);
  std::size_t num_strings = 0;
  reader.get(num_strings);
  for (std::size_t k = 0; k < num_strings; ++k) {
    std::vector<EdgeCrossing>& string = checkpoint.state.wraps.emplace_back();
    std::size_t num_crossings = 0;
    reader.get(num_crossings);
    for (std::size_t i = 0; i < num_crossings; ++i)
      each_of_crossing(string.emplace_back(), get_member);
  }
  std::size_t num_boluses = 0;
  reader.get(num_boluses);
  for (std::size_t k = 0; k < num_boluses; ++k) reader.get(checkpoint.state.boluses.emplace_back());
  std::size_t num_ways = 0;
  reader.get(num_ways);
  for (std::size_t k = 0; k < num_ways; ++k) reader.get(checkpoint.state.ways.emplace_back());
  return checkpoint;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                      const std::string& fingerprint) {
  std::string bytes = kMagic;
  const auto put_member = [&](const auto& member) { put(member, bytes); };
  bytes += fingerprint;
  each_of_checkpoint(checkpoint, put_member);
  const auto& overlaps = checkpoint.state.overlap_resolution.overlaps;
  put(overlaps.size(), bytes);
  for (const ResolvedOverlap& overlap : overlaps) each_of_overlap(overlap, put_member);
  put_vector(checkpoint.state.y, bytes);
  put(checkpoint.state.wraps.size(), bytes);
  for (const std::vector<EdgeCrossing>& string : checkpoint.state.wraps) {
    put(string.size(), bytes);
    for (const EdgeCrossing& crossing : string) each_of_crossing(crossing, put_member);
  }
  put(checkpoint.state.boluses.size(), bytes);
  for (const BolusState& bolus : checkpoint.state.boluses) put(bolus, bytes);
  put(checkpoint.state.ways.size(), bytes);
  for (const Way& way : checkpoint.state.ways) put(way, bytes);
  put(hash_bytes(bytes), bytes);
  std::error_code error;
  // Not made anew: a checkpoint without the files that it refers to.
  if (!std::filesystem::is_directory(std::filesystem::absolute(folder).parent_path(), error))
    throw SystemError(folder.string() + ": the folder of the results is gone");
  make_folders(folder);
  if (std::filesystem::exists(folder / kNewest, error))
    std::filesystem::rename(folder / kNewest, folder / kBefore, error);
  if (error)
    throw SystemError((folder / kBefore).string() + ": can't be written: " + error.message());
  write_text_file(folder / kNewest, bytes);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                          const std::string& fingerprint,
                                          const std::function<void(const std::string&)>& warn) {
  std::string damaged;
  for (const char* const name : {kNewest, kBefore}) {
    const std::filesystem::path file = folder / name;
    std::ifstream in(file, std::ios::binary);
    std::error_code unknown;
    if (!in && !std::filesystem::exists(file, unknown) && !unknown) continue;
    if (!in) throw SystemError(file.string() + ": can't be read");
    try {
      Checkpoint checkpoint = parsed({std::istreambuf_iterator<char>(in), {}}, fingerprint, file);
      if (damaged.empty()) return checkpoint;
      std::error_code ignored;
      std::filesystem::rename(file, folder / kNewest, ignored);
      if (warn)
        warn(
            fmt::format("{} is not a whole checkpoint; going on from the one before, of t = {:g} s",
                        damaged, checkpoint.state.t));
      return checkpoint;
    } catch (const Torn&) {
      damaged = file.string();
    }
  }
  if (damaged.empty()) return {};
  throw InputError(
      fmt::format("{} is not a whole checkpoint; run without --resume to start afresh", damaged));
}

}  // namespace articular::sim
