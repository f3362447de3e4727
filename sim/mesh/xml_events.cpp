#include "sim/mesh/xml_events.hpp"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
using Parser = std::unique_ptr<XML_ParserStruct, FreeParser>;

/// What expat's callbacks are given. No exception crosses them: it is kept and thrown behind them.
struct EventReading {
  const XmlEvents& events;
  XML_Parser parser;
  std::exception_ptr thrown{};
  bool has_doctype = false;

  template <class Event>
  void run(Event event) {
    if (thrown) return;
    try {
      if (event() == XmlNext::Stop) XML_StopParser(parser, XML_FALSE);
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }
};

EventReading& reading(void* data) { return *static_cast<EventReading*>(data); }

void on_start(void* data, const XML_Char* name, const XML_Char** pairs) {
  EventReading& r = reading(data);
  r.run([&] {
    if (!r.events.start) return XmlNext::Continue;
    XmlAttributes attributes;
    for (; *pairs != nullptr; pairs += 2) attributes.emplace(pairs[0], pairs[1]);
    return r.events.start(name, attributes,
                          static_cast<std::size_t>(XML_GetCurrentByteIndex(r.parser)));
  });
}

void on_text(void* data, const XML_Char* characters, int count) {
  EventReading& r = reading(data);
  r.run([&] {
    if (r.events.text) r.events.text(std::string_view(characters, static_cast<std::size_t>(count)));
    return XmlNext::Continue;
  });
}

void on_end(void* data, const XML_Char* name) {
  EventReading& r = reading(data);
  r.run([&] {
    if (r.events.end) r.events.end(name);
    return XmlNext::Continue;
  });
}

void on_doctype(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  EventReading& r = reading(data);
  r.has_doctype = true;
  XML_StopParser(r.parser, XML_FALSE);
}

}  // namespace

std::string attribute(const XmlAttributes& attributes, std::string_view name,
                      std::string_view otherwise) {
  const auto found = attributes.find(name);
  return found != attributes.end() ? found->second : std::string(otherwise);
}

void read_xml(const std::string& file, std::string_view format, std::string_view text,
              const XmlEvents& events) {
  const Parser parser(XML_ParserCreate(nullptr));
  if (!parser) throw std::bad_alloc();
  EventReading state{events, parser.get()};
  XML_SetUserData(parser.get(), &state);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_doctype);

  constexpr std::size_t kMost = std::size_t{1} << 30;  // expat counts in int
  XML_Status status = XML_STATUS_OK;
  do {
    const std::string_view part = text.substr(0, kMost);
    text.remove_prefix(part.size());
    status =
        XML_Parse(parser.get(), part.data(), static_cast<int>(part.size()), text.empty() ? 1 : 0);
  } while (status == XML_STATUS_OK && !text.empty());

  if (state.thrown) std::rethrow_exception(state.thrown);
  const XML_Error error = XML_GetErrorCode(parser.get());
  const auto refuse = [&](const std::string& what) {
    throw InputError({file, static_cast<int>(XML_GetCurrentLineNumber(parser.get()))},
                     "not readable as " + std::string(format) + ": " + what);
  };
  if (state.has_doctype) refuse("it defines a document type, which no such file does");
  if (status == XML_STATUS_ERROR && error != XML_ERROR_ABORTED) refuse(XML_ErrorString(error));
}

}  // namespace articular::sim
