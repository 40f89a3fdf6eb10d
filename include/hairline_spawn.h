/* The old name of hairline_offset.h. */
#include "hairline_offset.h"
