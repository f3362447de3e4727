#include "tests/faults/call_log.hpp"

#include <fstream>
#include <stdexcept>

namespace articular::faults {

std::string packed(const Call& call) {
  std::string text(1, static_cast<char>(call.kind));
  for (const std::uint64_t number :
       {static_cast<std::uint64_t>(call.handle + 1), call.offset,
        static_cast<std::uint64_t>(call.path.size()), static_cast<std::uint64_t>(call.to.size()),
        static_cast<std::uint64_t>(call.data.size())})
    text += ' ' + std::to_string(number);
  return text + '\n' + call.path + call.to + call.data;
}

std::vector<Call> read_calls(const std::filesystem::path& log) {
  std::ifstream in(log, std::ios::binary);
  std::vector<Call> calls;
  for (char kind = 0; in.get(kind);) {
    Call call;
    call.kind = static_cast<Call::Kind>(kind);
    std::size_t path = 0, to = 0, data = 0;
    in >> call.handle >> call.offset >> path >> to >> data;
    --call.handle;
    in.get();
    for (auto [size, text] :
         {std::pair{path, &call.path}, std::pair{to, &call.to}, std::pair{data, &call.data}}) {
      text->resize(size);
      in.read(text->data(), static_cast<std::streamsize>(size));
    }
    if (!in) throw std::runtime_error(log.string() + " ends within a call");
    calls.push_back(std::move(call));
  }
  return calls;
}

}  // namespace articular::faults
