// The compiler wants a source to hang the precompiled headers on.
