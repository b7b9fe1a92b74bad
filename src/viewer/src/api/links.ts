/** Links of the service, seen from the page. */

/** The address of a link of the service whose page is at `base`, which has no slash at its end. */
export function linked(base: string, link: string): string {
  const { origin, pathname } = new URL(base);
  const prefix = pathname.replace(/\/$/, "");
  return link.startsWith(`${prefix}/`) ? origin + link : base + link;
}
