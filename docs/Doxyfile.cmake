# The reference. Public is what programs include: the headers below. All others are the rooms' own, installed
# because these include some of them. A public name without a word on it is a warning, and a test's failure.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(volmesh_headers boundary cell_table collapse edge_removal edge_stars error face_removal face_surfaces handles io/mesh_io
  measure named_sets orientation overlap projector properties property_stats renumber retriangulation set_algebra
  smart_handles split_inside status strata submesh tet_mesh tet_mesh_properties tet_navigation tet_ranges tet_topology
  tri_mesh validate)
set(quality_headers cell_measures improve measures projection_result report)
set(refine_headers lineage longest_edge marking paper refine size_field uniform)
set(modeler_headers build build_report csg_tree facet_complex merge model outline primitive shapes solid tessellate
  tetrahedralize)
set(public_files)
foreach(room volmesh quality refine modeler)
  list(APPEND public_files ${room}/README.md)
  foreach(header ${${room}_headers})
    list(APPEND public_files ${room}/${header}.hh)
  endforeach()
endforeach()

set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${PROJECT_SOURCE_DIR}/README.md)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_PRIVATE NO)
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_DISTRIBUTE_GROUP_DOC YES)
set(DOXYGEN_EXCLUDE_SYMBOLS maille::volmesh::NamedSets maille::volmesh::NamedSets::* *::Iterator std::*)
set(DOXYGEN_WARN_IF_UNDOCUMENTED YES)
set(DOXYGEN_WARN_NO_PARAMDOC NO)
set(DOXYGEN_WARN_LOGFILE ${PROJECT_BINARY_DIR}/docs/warnings.txt)
doxygen_add_docs(docs README.md CONTRIBUTING.md docs volmesh/io/README.md ${public_files}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "The reference by Doxygen")

if(MAILLE_BUILD_TESTS)
  add_test(NAME "docs: every public name has a word on it"
    COMMAND sh -c "\"$1\" \"$2/Doxyfile.docs\" > \"$2/docs/doxygen.txt\" && ! grep . \"$2/docs/warnings.txt\""
      sh ${DOXYGEN_EXECUTABLE} ${PROJECT_BINARY_DIR}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
endif()
