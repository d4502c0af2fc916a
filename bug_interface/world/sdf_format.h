// What may stand where in an SDF file, for all versions from 1.2 to 1.12.
#pragma once

#include "core/xml/rules.h"

namespace forage::bug {

/// Of worlds and models.
const xml::Format& sdf_format();
/// Of the <plugin> that holds the rules of a game.
const xml::Format& game_format();
/// Of the file model.config; it has no table, as only one of its elements is read.
const xml::Format& model_config_format();

}  // namespace forage::bug
