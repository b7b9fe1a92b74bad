// The scripts and styles that the viewer's page can load.

/** Each with its bytes, and whether the page loads it at once. */
export async function bundle(address) {
  const base = new URL("/", address);
  const html = await (await fetch(base)).text();
  const files = new Map();
  const atOnce = names(html);
  const load = async (name) => {
    if (files.has(name)) return;
    files.set(name, null);
    const body = Buffer.from(await (await fetch(new URL(`assets/${name}`, base))).arrayBuffer());
    files.set(name, { name, first: atOnce.includes(name), body });
    for (const found of names(body.toString())) await load(found);
  };
  for (const name of atOnce) await load(name);
  return [...files.values()];
}

function names(text) {
  return [...text.matchAll(/["/]([\w-]+-[\w-]{8}\.(?:js|css))"/g)].map(([, name]) => name);
}
