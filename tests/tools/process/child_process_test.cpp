// A program that is started ends with the object that holds it, even if it is slow to obey.
#include "tools/process/child_process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string>

namespace articular::tools::child_process_test {

/// Starts a shell with `commands` after it has told its process number on descriptor 3, and lets go
/// of it. @return that number
pid_t started_and_ended(const std::string& commands) {
  Pipe told;
  std::string number;
  {
    ChildProcess child;
    EXPECT_EQ(
        ChildProcess::start(
            {"sh", "-c", commands + "; echo $$ >&3; exec 3>&-; " + "while :; do sleep 0.01; done"},
            told.write_end.get(), 3, child),
        ChildProcess::Started::Yes);
    told.write_end.close();
    for (char c = 0; ::read(told.read_end.get(), &c, 1) == 1 && c != '\n';) number += c;
  }
  return static_cast<pid_t>(std::stol(number));
}

TEST(ChildProcess, EndsWithItsObject) {
  for (const char* const commands : {"true",
                                     "trap 'trap - TERM' TERM",  // forgets the first request
                                     "trap '' TERM"}) {          // hears none
    const pid_t pid = started_and_ended(commands);
    EXPECT_EQ(::kill(pid, 0), -1) << commands;
    EXPECT_EQ(errno, ESRCH) << commands;
  }
}

}  // namespace articular::tools::child_process_test
