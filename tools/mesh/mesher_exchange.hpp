#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

/// What `articular mesh` and its mesher, a program of its own, say to each other through one
/// socket. Both run on one machine, from one build: numbers go as they stand in memory, each list
/// behind its length.
///
/// To the mesher:   MesherRequest, points (x0 y0 z0 x1 ...), triangles (three indices each);
///                  then nothing more.
/// From the mesher: MesherReply, and then, by its kind,
///                  Mesh: points, tetrahedra (four indices each); Crossings: pairs of triangles
///                  that intersect; Failed: a text.
namespace articular::tools {

/// The socket's number in the mesher.
constexpr int kMesherSocket = 3;

/// Lengths in the unit of the points.
struct MesherRequest {
  double size = 0;             // mean edge that is asked for
  double distance = 0;         // bound of the surface's distance from its facets
  double sharp_edges_deg = 0;  // edges that turn by more are kept; 0: none
  std::int32_t crossings = 0;  // 1: triangles may intersect each other
  std::int32_t padding = 0;
};

enum class MesherReply : std::int32_t { Mesh, Crossings, Failed };

/// False when the other end is gone.
inline bool send_bytes(int socket, const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = ::send(socket, next, size, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    next += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

template <class T>
bool send_value(int socket, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return send_bytes(socket, &value, sizeof value);
}

template <class T>
bool send_list(int socket, const std::vector<T>& list) {
  static_assert(std::is_trivially_copyable_v<T>);
  return send_value(socket, static_cast<std::uint64_t>(list.size())) &&
         send_bytes(socket, list.data(), list.size() * sizeof(T));
}

/// Takes values out of what the other end has sent, in order.
class ReceivedBytes {
 public:
  explicit ReceivedBytes(const std::string& bytes) : bytes_(bytes) {}

  /// False when there is not as much left.
  template <class T>
  bool take(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return take_bytes(&value, sizeof value);
  }

  template <class T>
  bool take(std::vector<T>& list) {
    std::uint64_t size = 0;
    if (!take(size) || size > (bytes_.size() - position_) / sizeof(T)) return false;
    list.resize(size);
    return take_bytes(list.data(), size * sizeof(T));
  }

 private:
  bool take_bytes(void* data, std::size_t size) {
    if (size > bytes_.size() - position_) return false;
    if (size > 0) std::memcpy(data, bytes_.data() + position_, size);
    position_ += size;
    return true;
  }

  const std::string& bytes_;
  std::size_t position_ = 0;
};

}  // namespace articular::tools
