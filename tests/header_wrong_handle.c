/* Must not compile: a film is no scene. */
#include <bdpt.h>

void release(bdpt_film *film);
void release(bdpt_film *film) { bdpt_scene_release(film); }
