#include "tools/html/page.hh"

#include <string_view>

#include "tools/html/contents.hh"
#include "volmesh/io/output_file.hh"

namespace maille::html {
namespace {

// What page/ was bundled into: the script makes all the page from the figures and arrays.
constexpr char script[] =
#include <page.js.inc>
    ;

std::string escaped(std::string_view text) {
    std::string out;
    for (char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

/// JSON that cannot end the element that it stands in.
std::string within_script(const nlohmann::ordered_json& json) {
    std::string out;
    for (char c : json.dump(-1, ' ', true)) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

}  // namespace

void write_page(const volmesh::TetMesh& mesh, const quality::Report& report, const std::string& path,
                const PageOptions& options) {
    const Contents contents = contents_of(mesh, report, options);
    volmesh::io::OutputFile file(path);
    file << "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         << "<link rel=\"icon\" href=\"data:,\">\n<title>" << escaped(options.title)
         << " - mesh quality</title>\n</head>\n<body>\n"
         << "<script type=\"application/json\" id=\"figures\">" << within_script(contents.figures)
         << "</script>\n<script type=\"text/plain\" id=\"arrays\">"
         << compressed_base64(contents.blob.bytes()) << "</script>\n<script>"
         << std::string_view(script, sizeof script - 1) << "</script>\n</body>\n</html>\n";
    file.commit();
}

}  // namespace maille::html
