#include "tools/mesh/mesher.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <filesystem>
#include <system_error>

#include "sim/base/error.hpp"
#include "tools/mesh/mesher_exchange.hpp"
#include "tools/process/child_process.hpp"
#include "tools/process/this_program.hpp"

namespace articular::tools {
namespace {

constexpr double kMesherUnit = 1e-3;  // [m]; positions go to the mesher in mm

/// In a build it lies beside this program; installed, where programs lie that only others start.
std::filesystem::path mesher_program() {
  const std::filesystem::path folder = this_program().parent_path();
  const std::filesystem::path beside = folder / "articular-mesher";
  const std::filesystem::path installed =
      folder.parent_path() / "libexec" / "articular" / "articular-mesher";
  std::error_code error;
  for (const std::filesystem::path& mesher : {beside, installed})
    if (std::filesystem::exists(mesher, error)) return mesher;
  throw sim::SystemError(fmt::format(
      "the mesher is missing: neither {} nor {} is there. Debian's package is "
      "articular-mesher; a release build makes it (tools/build release articular) where "
      "libcgal-dev is installed",
      beside.string(), installed.string()));
}

bool send_request(int socket, const Shell& shell, const MesherSettings& settings) {
  MesherRequest request;
  request.size = settings.size / kMesherUnit;
  request.distance = settings.distance / kMesherUnit;
  request.sharp_edges_deg = settings.sharp_edges_deg;
  request.crossings = settings.crossings ? 1 : 0;
  const Positions x = shell.X / kMesherUnit;
  const std::vector<double> points(x.data(), x.data() + x.size());
  const std::vector<std::int32_t> corners(shell.triangles.data(),
                                          shell.triangles.data() + shell.triangles.size());
  return send_value(socket, request) && send_list(socket, points) && send_list(socket, corners) &&
         ::shutdown(socket, SHUT_WR) == 0;
}

std::string receive_reply(int socket, const std::function<bool()>& interrupted) {
  constexpr int kLookAroundMs = 100;
  std::string bytes;
  char block[1 << 16];
  while (true) {
    if (interrupted()) throw MeshingInterrupted{};
    pollfd wait{socket, POLLIN, 0};
    if (::poll(&wait, 1, kLookAroundMs) <= 0) continue;
    const ssize_t count = ::read(socket, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(block, static_cast<std::size_t>(count));
  }
}

[[noreturn]] void refuse_crossings(const std::string& name, const Shell& shell, double unit,
                                   const std::vector<std::int32_t>& pairs) {
  const auto number = [&](std::int32_t f) {
    return shell.face_numbers.at(static_cast<std::size_t>(f)) + 1;
  };
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < 3; ++k) place += shell.X.col(shell.triangles(k, pairs.at(0))) / 3;
  place /= unit;
  throw sim::InputError(
      {name},
      fmt::format("faces {} and {} intersect, near ({:.6g} {:.6g} {:.6g}), one of {} such "
                  "pairs; expected a surface that doesn't cross itself (--crossings takes it "
                  "as it is)",
                  number(pairs.at(0)), number(pairs.at(1)), place(0), place(1), place(2),
                  pairs.size() / 2));
}

[[noreturn]] void fail(const std::string& name, const std::string& why) {
  throw sim::SystemError(name + ": the mesher failed: " + why);
}

TetMesh received_mesh(const std::string& name, ReceivedBytes& reply) {
  std::vector<double> points;
  std::vector<std::int32_t> corners;
  if (!reply.take(points) || !reply.take(corners)) fail(name, "its mesh did not arrive whole");
  if (corners.empty())
    throw sim::InputError({name}, "no element of this size fits in; expected a smaller --size");
  TetMesh mesh;
  mesh.X = kMesherUnit * Eigen::Map<const Positions>(points.data(), 3,
                                                     static_cast<Eigen::Index>(points.size() / 3));
  mesh.tets = Eigen::Map<const Tetrahedra>(corners.data(), 4,
                                           static_cast<Eigen::Index>(corners.size() / 4));
  return mesh;
}

}  // namespace

TetMesh mesh_shell(const std::string& name, const Shell& shell, double unit,
                   const MesherSettings& settings, const std::function<bool()>& interrupted) {
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw sim::SystemError("can't make a socket to the mesher: " +
                           std::system_category().message(errno));
  const FileDescriptor ours(ends[0]);
  FileDescriptor theirs(ends[1]);
  const std::string program = mesher_program().string();
  ChildProcess mesher;
  if (ChildProcess::start({program}, theirs.get(), kMesherSocket, mesher) ==
      ChildProcess::Started::NotInstalled)
    throw sim::SystemError(program + ": can't be started");
  theirs.close();
  if (!send_request(ours.get(), shell, settings)) fail(name, "it takes no surface");
  const std::string bytes = receive_reply(ours.get(), interrupted);
  ReceivedBytes reply(bytes);
  MesherReply kind{};
  if (!reply.take(kind)) fail(name, "it ended without an answer (out of memory?)");
  if (kind == MesherReply::Mesh) return received_mesh(name, reply);
  if (kind == MesherReply::Crossings) {
    std::vector<std::int32_t> pairs;
    if (!reply.take(pairs) || pairs.size() < 2) fail(name, "its answer did not arrive whole");
    refuse_crossings(name, shell, unit, pairs);
  }
  std::vector<char> text;
  fail(name, reply.take(text) ? std::string(text.begin(), text.end()) : "for no known reason");
}

}  // namespace articular::tools
