#pragma once

/// stdin, stdout and stderr of a program that may be started without them, or with a full disk or a
/// closed pipe behind them.
namespace articular::tools {

/// One that is closed is opened so that every read and write of it fails. Left closed, the next
/// file that is opened would have its number: a file of results, and messages would go into it.
/// @throws sim::SystemError
void open_closed_streams();

/// Sends what was printed on its way. @throws sim::SystemError where some of it is lost
void flush_streams();

/// Whether something that was printed is lost: fmt::print() then throws what looks like a bug.
bool is_text_lost();

}  // namespace articular::tools
