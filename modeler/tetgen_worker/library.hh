#pragma once

// TetGen's own header, included here alone: what it defines is global, and the worker's.
#include <tetgen.h>
