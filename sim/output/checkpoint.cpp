#include "sim/output/checkpoint.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

constexpr char kMagic[] = "articular checkpoint 7\n";

/// FNV-1a: a plain hash is enough to notice damage and mix-ups.
std::uint64_t hash_bytes(const char* data, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::size_t i = 0; i < size; ++i)
    hash = (hash ^ static_cast<unsigned char>(data[i])) * 1099511628211ULL;
  return hash;
}

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

/// Takes values off the front of a file's bytes.
/// The file ends too early or is no checkpoint.
struct Torn {};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
  }
  void get_vector(Eigen::VectorXd& values) {
    Eigen::Index size = 0;
    get(size);
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

template <class Extrema, class Visit>
void each_of_extrema(Extrema& extrema, const Visit& visit) {
  visit(extrema.volume_ratio);
  visit(extrema.tissue);
  visit(extrema.element);
  visit(extrema.squeezed_at);
  visit(extrema.overlap);
  visit(extrema.contact);
  visit(extrema.overlap_at);
  visit(extrema.kinetic);
  visit(extrema.work);
  visit(extrema.made);
  visit(extrema.gravity_low);
  visit(extrema.gravity_high);
}

}  // namespace

std::string fingerprint(const Scenario& scenario, const Model& model) {
  std::string bytes = scenario.content;
  const auto put_numbers = [&bytes](const auto& matrix) {
    bytes.append(reinterpret_cast<const char*>(matrix.data()),
                 static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data()));
  };
  put_numbers(initial_state(model));
  for (const BodyModel& body : model.bodies) {
    put_numbers(body.X);
    if (body.collider) put_numbers(body.collider->X);
    if (body.collider) put_numbers(body.collider->tets);
  }
  for (const Tissue& tissue : model.tissues) put_numbers(tissue.elements.tets());
  for (const RigidBody& rigid : model.rigid_bodies) put_numbers(rigid.rest.p);
  for (const MuscleModel& muscle : model.muscles) {
    put(muscle.given.max_force, bytes);
    put(muscle.given.max_length_ratio, bytes);
    put(muscle.given.tendon_ratio, bytes);
  }
  for (const Line& line : model.lines) put(line.start_length, bytes);
  return fmt::format("{:016x}", hash_bytes(bytes.data(), bytes.size()));
}

void write_checkpoint(const std::filesystem::path& file, const State& state,
                      const std::string& fingerprint) {
  std::string bytes = kMagic;
  const auto put_member = [&](const auto& member) { put(member, bytes); };
  bytes += fingerprint;
  put(state.t, bytes);
  put(state.next_step, bytes);
  put(state.next_margin, bytes);
  put(state.max_penetration, bytes);
  put(state.frames, bytes);
  put(state.energy, bytes);
  put(state.counts, bytes);
  each_of_extrema(state.extrema, put_member);
  put(state.overlap_resolution.solutions, bytes);
  put(state.overlap_resolution.largest_motion, bytes);
  put(state.overlap_resolution.overlaps.size(), bytes);
  for (const ResolvedOverlap& overlap : state.overlap_resolution.overlaps)
    each_of_overlap(overlap, put_member);
  put_vector(state.y, bytes);
  put(hash_bytes(bytes.data(), bytes.size()), bytes);
  write_text_file(file, bytes);
}

std::optional<State> read_checkpoint(const std::filesystem::path& file,
                                     const std::string& fingerprint) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  State state;
  try {
    if (bytes.size() < sizeof(std::uint64_t)) throw Torn{};
    const std::size_t body = bytes.size() - sizeof(std::uint64_t);
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes.data() + body, sizeof(stored));
    if (stored != hash_bytes(bytes.data(), body)) throw Torn{};
    Reader reader(std::string_view(bytes).substr(0, body));
    if (reader.take(std::strlen(kMagic)) != kMagic) throw Torn{};
    if (reader.take(fingerprint.size()) != fingerprint)
      throw InputError(
          fmt::format("{} belongs to another scenario, mesh or setting; run without "
                      "--resume or choose another --out",
                      file.string()));
    reader.get(state.t);
    reader.get(state.next_step);
    reader.get(state.next_margin);
    reader.get(state.max_penetration);
    reader.get(state.frames);
    reader.get(state.energy);
    reader.get(state.counts);
    const auto get_member = [&](auto& member) { reader.get(member); };
    each_of_extrema(state.extrema, get_member);
    reader.get(state.overlap_resolution.solutions);
    reader.get(state.overlap_resolution.largest_motion);
    std::size_t num_overlaps = 0;
    reader.get(num_overlaps);
    for (std::size_t k = 0; k < num_overlaps; ++k)
      each_of_overlap(state.overlap_resolution.overlaps.emplace_back(), get_member);
    reader.get_vector(state.y);
  } catch (const Torn&) {
    throw InputError(
        fmt::format("{} is not a whole checkpoint; remove it to start afresh", file.string()));
  }
  return state;
}

}  // namespace articular::sim
