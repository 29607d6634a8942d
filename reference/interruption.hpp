#pragma once

namespace reference {

/// From now on every step of a long integration calls `hook`, which may throw to give it up; null for none.
void on_every_step(void (*hook)());

/// Calls the hook, if there is one.
void between_steps();

}  // namespace reference
