#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "tools/html/blob.hh"
#include "tools/html/page.hh"

namespace maille::html {

/// What the page is told: figures as JSON, and the arrays that `page/mesh.js` takes the mesh from.
struct Contents {
    nlohmann::ordered_json figures;
    Blob blob;
};

Contents contents_of(const volmesh::TetMesh& mesh, const quality::Report& report, const PageOptions& options);

}  // namespace maille::html
